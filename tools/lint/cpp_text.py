"""A light reader of C++ sources: their comments, and the functions that they declare and define.

It knows the form of our sources (clang-format, no macros that make declarations), not all of C++.
What it cannot read as a function it passes over.
"""
import bisect
import dataclasses
import re

TOKEN = re.compile(r"""
    (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<hash>^[ \t]*\#(?:[^\n\\]|\\.)*)
  | R"(?P<mark>\w*)\((?P<raw>.*?)\)(?P=mark)"
  | "(?:\\.|[^"\\\n])*"
  | (?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'
""", re.DOTALL | re.VERBOSE | re.MULTILINE)


def blanked(text):
    """The code alone, each character at its place: blanks for comments, texts and directives."""
    def blank(match):
        kept = re.sub(r"[^\n]", " ", match[0])
        is_text = not match["comment"] and not match["hash"] and len(kept) > 1
        return '"' + kept[1:-1] + '"' if is_text else kept
    return TOKEN.sub(blank, text)


def comments(text):
    """(line, text) of every comment; whole lines of comment that follow each other are one."""
    found, end = [], None
    for token in TOKEN.finditer(text):
        if token["comment"] is None:
            continue
        words = re.sub(r"^(//+|/\*+)[ \t]?|\*/$", "", token["comment"])
        line = text.count("\n", 0, token.start()) + 1
        between = text[end:token.start()] if end is not None else None
        begins_line = not text[text.rfind("\n", 0, token.start()) + 1:token.start()].strip()
        if begins_line and between is not None and not between.strip() and \
                between.count("\n") == 1:
            found[-1][1] += "\n" + words
        else:
            found.append([line, words])
        end = token.end()
    return [(line, words) for line, words in found]


@dataclasses.dataclass
class Function:
    name: str          # with its namespaces and classes
    parameters: tuple  # their types, without names
    defined: bool
    first: int         # lines
    last: int
    local: bool        # static, or in a namespace without a name


@dataclasses.dataclass
class Type:
    name: str
    line: int
    start: int  # where its brace opens


KEYWORDS = {"int", "double", "float", "bool", "char", "long", "short", "unsigned", "signed", "auto",
            "void", "const"}
NO_FUNCTIONS = {"if", "for", "while", "switch", "return", "alignas", "decltype", "static_assert",
                "noexcept", "requires", "sizeof", "__attribute__"}
WORD = re.compile(r"[A-Za-z_]\w*|::|->|\d[\w.']*|\S")
NAMESPACE = re.compile(r"^(?:inline\s+)?namespace\b\s*([\w:]*)\s*$")
CLASS = re.compile(r"^(?:class|struct|union)\b(?:\s*\[\[.*?\]\]|\s+alignas\s*\([^)]*\))*"
                   r"\s+([\w:]+(?:\s*<.*>)?)\s*(?:final\b)?\s*(?::(?!:).*)?$", re.DOTALL)
OPERATOR = re.compile(r"\boperator\s*(\(\s*\)|\[\s*\]|[-+*/%^&|~!=<>,]+|\"\"\s*\w+|[\w:<>*& ]+?)"
                      r"\s*(?=\()")
ANGLES = {"<": 1, ">": -1}
PARENTHESES = {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}


def closing(text, at):
    """Where the bracket that opens at `at` closes; the end where it does not."""
    depth = 0
    for position in range(at, len(text)):
        depth += PARENTHESES.get(text[position], 0)
        if depth == 0:
            return position
    return len(text) - 1


def after_angles(text, at):
    """Behind the template brackets that open at `at`; at + 1 where these are none."""
    depth = 0
    position = at
    while position < len(text):
        if text[position] == ">" and text[position - 1] == "-":
            pass
        elif text[position] in ANGLES:
            depth += ANGLES[text[position]]
            if depth == 0:
                return position + 1
        elif text[position] in "([{":
            position = closing(text, position)
        elif text[position] in ")]};":
            break
        position += 1
    return at + 1


def without_template(head):
    """The head of a declaration, without `template <...>`, attributes and access labels."""
    while True:
        head = head.strip()
        label = re.match(r"(?:public|private|protected)\s*:(?!:)", head)
        attribute = re.match(r"\[\[.*?\]\]", head, re.DOTALL)
        if label or attribute:
            head = head[(label or attribute).end():]
        elif re.match(r"template\s*<", head):
            head = head[after_angles(head, head.index("<")):]
        elif re.match(r"requires\s*\(", head):
            head = head[closing(head, head.index("(")) + 1:]
        elif re.match(r"requires\s", head):
            clause = re.match(r"requires\s+(?:!?[\w:]+(?:\s*<[^;{}()]*?>)?(?:\s*(?:&&|\|\|)\s*)?)+"
                              r"(?=\s+\w)", head)
            if clause is None:
                return head
            head = head[clause.end():]
        else:
            return head


def split_parameters(text):
    parts, start, position = [], 0, 0
    while position < len(text):
        letter = text[position]
        if letter in "([{":
            position = closing(text, position)
        elif letter == "<":
            position = after_angles(text, position) - 1
        elif letter == ",":
            parts.append(text[start:position])
            start = position + 1
        position += 1
    parts.append(text[start:])
    return [part for part in (p.strip() for p in parts) if part and part != "void"]


def type_of(parameter):
    """The type of a parameter in one form: no name, no default, no namespaces."""
    parameter = re.sub(r"\[\[.*?\]\]|\b__restrict\b", "", parameter)
    words, depth, kept = WORD.findall(parameter), 0, []
    for word in words:
        depth += PARENTHESES.get(word, ANGLES.get(word, 0))
        if word == "=" and depth == 0:
            break
        kept.append(word)
    named = len(kept) > 1 and re.match(r"[A-Za-z_]", kept[-1]) and kept[-1] not in KEYWORDS
    if named and kept[-2] != "::" and not (len(kept) == 2 and kept[0] in ("const", "struct")):
        kept.pop()
    if kept and kept[0] == "const" and not any(w in kept for w in "&*"):
        kept.pop(0)
    text = " ".join(kept)
    return re.sub(r"(?:\b\w+ )?:: ", "", re.sub(r"(?:\b\w+ :: )+", "", text))


def function_in(head):
    """(name, parameters) of the function that a head without template declares, or None."""
    operator = OPERATOR.search(head)
    if operator:
        before = head[:operator.start()]
        if "=" not in before and "(" not in re.sub(r"<.*>", "", before):
            owner = re.search(r"((?:\w+(?:<[^()<> ]*>)?::)*)$", before.rstrip())
            name = (owner[1] if owner else "") + "operator" + re.sub(r"\s+", "", operator[1])
            open_at = operator.end()
            return name, head[open_at + 1:closing(head, open_at)], head[:operator.start()]
    position = 0
    while position < len(head):
        letter = head[position]
        if letter == "<":
            position = after_angles(head, position)
            continue
        if letter in "[{":
            position = closing(head, position)
        if letter == "=":
            return None
        if letter == "(":
            before = head[:position].rstrip()
            name = re.search(r"((?:\w+(?:<[^()<> ]*>)?::)*~?\w+)$", before)
            if name is None:
                return None
            if re.split(r"::|\s", name[1])[-1] in NO_FUNCTIONS:
                position = closing(head, position) + 1
                continue
            end = closing(head, position)
            return re.sub(r"\s|<.*?>", "", name[1]), head[position + 1:end], head[:name.start()]
        position += 1
    return None


def is_initialiser(head, at_end):
    """Whether the brace behind a constructor's head only opens a member's first value."""
    function = function_in(head)
    if function is None:
        return False
    open_at = head.index("(", len(function[2]))
    rest = head[closing(head, open_at) + 1:]
    return bool(re.match(r"\s*(?:noexcept\s*)?:(?!:)", rest)) and \
        bool(re.search(r"[\w>]$", at_end.rstrip()))


class Reader:
    def __init__(self, text):
        self.code = blanked(text)
        self.ends = [m.start() for m in re.finditer("\n", text)]
        self.functions, self.types = [], []

    def line(self, position):
        return bisect.bisect_left(self.ends, position) + 1

    def read(self):
        self.scope(0, len(self.code), (), False, False)
        return self

    def first_of(self, start):
        return re.compile(r"\s*").match(self.code, start).end()

    def keep(self, head, start, end, names, local, defined):
        function = function_in(head)
        if function is None:
            return
        name, parameters, before = function
        words = before.split()
        if "friend" in words or "using" in words or "typedef" in words or "return" in words:
            return
        alone = not before.strip() and not names
        if alone and not defined:
            return  # a macro
        self.functions.append(Function(
            "::".join([*names, name]), tuple(type_of(p) for p in split_parameters(parameters)),
            defined, self.line(self.first_of(start)), self.line(end),
            local or ("static" in words and "::" not in name and self.in_namespace)))

    def scope(self, start, end, names, local, in_class):
        """Reads what lies from start to end, in a namespace or a class."""
        statement = position = start
        while position < end:
            letter = self.code[position]
            if letter in "([":
                position = closing(self.code, position)
            elif letter == ";":
                self.in_namespace = not in_class
                self.keep(without_template(self.code[statement:position]), statement, position,
                          names, local, "= default" in self.code[statement:position])
                statement = position + 1
            elif letter == "{":
                position, statement = self.brace(statement, position, names, local, in_class)
            elif letter == ":" and in_class and re.match(
                    r"\s*(?:public|private|protected)\s*$", self.code[statement:position]):
                statement = position + 1
            position += 1

    def brace(self, statement, position, names, local, in_class):
        """What an opening brace begins: (where it closes, where the next statement starts)."""
        head = without_template(self.code[statement:position])
        end = closing(self.code, position)
        space, kind = NAMESPACE.match(head), CLASS.match(head)
        if space:
            inner = tuple(n for n in space[1].split("::") if n)
            self.scope(position + 1, end, names + inner, local or not inner, False)
            return end, end + 1
        if kind:
            name = re.sub(r"\s|<.*>", "", kind[1])
            self.types.append(Type("::".join([*names, name]), self.line(position), position))
            self.scope(position + 1, end, names + tuple(name.split("::")), local, True)
            return end, end + 1
        if re.match(r"enum\b", head):
            name = re.match(r"enum\s+(?:class\s+|struct\s+)?(\w+)", head)
            if name:
                self.types.append(Type("::".join([*names, name[1]]), self.line(position), position))
            return end, end + 1
        if re.match(r'extern\s*"', head):
            self.scope(position + 1, end, names, local, False)
            return end, end + 1
        if function_in(head) and not is_initialiser(head, self.code[statement:position]):
            self.in_namespace = not in_class
            self.keep(head, statement, end, names, local, True)
            return end, end + 1
        return end, statement


def fields(reader):
    """Full names of what may be a data member or an enumerator: words before one of ; = { , }."""
    for kind in reader.types:
        body = reader.code[kind.start:closing(reader.code, kind.start)]
        for line in body.split("\n"):
            for name in re.findall(r"\b([A-Za-z_]\w*)\s*(?=[;={,}]|$)", line):
                yield f"{kind.name}::{name}"


def read(text):
    return Reader(text).read()
