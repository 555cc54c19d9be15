"""Tests of the checks of rooms: small trees with one known fault each."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_declarations  # noqa: E402
import check_layers  # noqa: E402
import cpp_text  # noqa: E402
from lint_tree import Tree  # noqa: E402


class Layers(Tree):
    def faults(self):
        return check_layers.check_arrows(self.root)

    def test_downward_is_allowed(self):
        self.write("framework/base/a.hpp", "// a\n")
        self.write("ice/b.cpp", '// b\n#include "framework/base/a.hpp"\n#include <vector>\n')
        self.assertEqual(self.faults(), [])

    def test_upward_is_named_with_its_line(self):
        self.write("ice/b.hpp", "// b\n")
        self.write("framework/base/a.cpp", '// a\n#include "ice/b.hpp"\n')
        faults = self.faults()
        self.assertEqual(len(faults), 1)
        self.assertIn("framework/base/a.cpp:2: framework/base may not include ice", faults[0])

    def test_ice_and_mpm_do_not_know_each_other(self):
        self.write("mpm/m.hpp", "// m\n")
        self.write("ice/b.cpp", '// b\n#include "mpm/m.hpp"\n')
        self.assertEqual(len(self.faults()), 1)

    def test_floors_of_a_house(self):
        self.write("ice/fluid/f.hpp", "// f\n")
        self.write("ice/mixture/m.hpp", '// m\n#include "ice/fluid/f.hpp"\n')
        self.write("ice/fluid/g.cpp", '// g\n#include "ice/mixture/m.hpp"\n')
        self.write("ice/ice.hpp", "// top\n")
        self.write("ice/mixture/n.cpp", '// n\n#include "ice/ice.hpp"\n')
        faults = self.faults()
        self.assertEqual(len(faults), 2)
        self.assertIn("ice/fluid/g.cpp:2: ice/fluid may not include ice/mixture", faults[0])
        self.assertIn("ice/mixture/n.cpp:2: ice/mixture may not include ice (", faults[1])

    def test_rooms_of_one_floor_do_not_know_each_other(self):
        self.write("ice/levels/l.hpp", "// l\n")
        self.write("ice/budgets/a.cpp", '// a\n#include "ice/levels/l.hpp"\n')
        self.assertEqual(len(self.faults()), 1)

    def test_tests_may_use_their_house_and_test_support(self):
        self.write("ice/ice.hpp", "// top\n")
        self.write("ice/test_support/s.hpp", '// s\n#include "ice/ice.hpp"\n')
        self.write("ice/fluid/f_test.cpp", '// f\n#include "ice/test_support/s.hpp"\n')
        self.assertEqual(self.faults(), [])
        self.write("ice/fluid/f.cpp", '// f\n#include "ice/test_support/s.hpp"\n')
        self.assertEqual(len(self.faults()), 1)

    def test_unknown_room_of_a_house(self):
        self.write("ice/attic/a.cpp", "// a\n")
        self.assertIn("'ice/attic' is no room", self.faults()[0])

    def test_rooms_inside_rooms(self):
        self.write("app/plan/p.hpp", "// p\n")
        self.write("app/commands/c.cpp", '// c\n#include "app/plan/p.hpp"\n')
        self.write("app/study/s.cpp", '// s\n#include "app/plan/p.hpp"\n')
        self.write("ice/step/s.hpp", "// s\n")
        self.write("mpmice/m.cpp", '// m\n#include "ice/step/s.hpp"\n')
        self.assertEqual(self.faults(), [
            "app/study/s.cpp:2: app/study may not include app/plan (app/plan/p.hpp): "
            "arrows run downward only"])

    def test_the_files_of_a_folder_stand_where_its_list_says(self):
        self.write("framework/deck/top.hpp", "// top\n")
        self.write("framework/deck/format/f.hpp", '// f\n#include "framework/deck/top.hpp"\n')
        self.write("models/models.hpp", '// m\n#include "models/gases/g.hpp"\n')
        self.write("models/gases/g.hpp", "// g\n")
        self.assertEqual(self.faults(), [])
        self.write("framework/deck/top.cpp", '// t\n#include "framework/deck/format/f.hpp"\n')
        self.write("models/gases/g.cpp", '// g\n#include "models/models.hpp"\n')
        self.assertEqual([fault.split(" (")[0] for fault in self.faults()], [
            "framework/deck/top.cpp:2: framework/deck may not include framework/deck/format",
            "models/gases/g.cpp:2: models/gases may not include models"])

    def test_helpers_of_tests_of_an_inner_room(self):
        self.write("framework/run/levels/l.hpp", "// l\n")
        self.write("framework/run/test_support/s.hpp",
                   '// s\n#include "framework/run/levels/l.hpp"\n')
        self.write("framework/run/component/c_test.cpp",
                   '// c\n#include "framework/run/test_support/s.hpp"\n')
        self.assertEqual(self.faults(), [])
        self.write("app/commands/c.cpp", '// c\n#include "framework/run/test_support/s.hpp"\n')
        self.assertEqual(len(self.faults()), 1)

    def test_files_lie_in_the_innermost_rooms(self):
        self.write("framework/run/a.cpp", "// a\n")
        self.write("framework/b.cpp", "// b\n")
        self.write("ice/fluid/inner/c.cpp", "// c\n")
        self.write("ice/attic/test_support/d.cpp", "// d\n")
        self.assertEqual(len(self.faults()), 4)

    def test_listed_rooms_exist(self):
        self.write("app/main.cpp", "// main\n")
        self.write("app/study/study_test.cpp", "// study\n")
        faults = list(check_layers.check_rooms(self.root))
        self.assertIn("rooms.py: 'app/plan': no such folder of sources", faults)
        self.assertIn("rooms.py: 'ice': no sources of its own", faults)
        self.assertFalse([f for f in faults if "'app'" in f or "'app/study'" in f])

    def test_circle_of_headers(self):
        self.write("ice/a.hpp", '// a\n#include "ice/b.hpp"\n')
        self.write("ice/b.hpp", '// b\n#include "ice/a.hpp"\n')
        faults = self.faults()
        self.assertEqual(faults, ["circle: ice/a.hpp -> ice/b.hpp -> ice/a.hpp"])

    def test_include_must_be_given_from_src(self):
        self.write("ice/b.hpp", "// b\n")
        self.write("ice/a.cpp", '// a\n#include "b.hpp"\n')
        self.assertIn('write "ice/b.hpp"', self.faults()[0])

    def test_unknown_room(self):
        self.write("misc/a.cpp", "// a\n")
        self.assertIn("no room of the design", self.faults()[0])


class Declarations(Tree):
    def faults(self):
        return check_declarations.check(self.root)

    def test_defined_in_the_room_of_the_header(self):
        self.write("ice/step/a.hpp", "namespace n {\nvoid f(int a, const B& b = {});\n}\n")
        self.write("ice/step/c.cpp", "namespace n {\nvoid f(int x, const B& y) {}\n}\n")
        self.assertEqual(self.faults(), [])

    def test_defined_above(self):
        self.write("ice/step/a.hpp", "namespace n {\nvoid f(int, const B&);\nvoid f(double);\n}\n")
        self.write("ice/mixture/c.cpp", "namespace n {\nvoid f(int x, const n::B& y) {}\n}\n")
        self.assertEqual(self.faults(), [
            "ice/step/a.hpp:2: 'n::f' is declared in ice/step and defined in ice/mixture "
            "(ice/mixture/c.cpp:2): declare it in a header of that room"])

    def test_members_and_declarations_in_a_source(self):
        self.write("app/plan/a.hpp", "struct A {\n  int f() const;\n};\n")
        self.write("app/study/b.cpp", "void g(A&);\nvoid h() { g(a); }\n")
        self.write("app/commands/c.cpp", "int A::f() const { return 1; }\nvoid g(A& a) {}\n")
        self.assertEqual(len(self.faults()), 2)

    def test_other_functions_of_one_name(self):
        self.write("app/plan/a.hpp", "namespace n {\nvoid f(int);\n}\nvoid g(int);\n")
        self.write("app/commands/c.cpp", "namespace n {\nvoid f(double) {}\n"
                   "namespace {\nvoid f(int) {}\n}\nnamespace m {\nvoid f(int) {}\n}\n}\n"
                   "static void g(int) {}\n")
        self.write("app/commands/d_test.cpp", "namespace n {\nvoid f(int) {}\n}\n")
        self.assertEqual(self.faults(), [])


class Reader(unittest.TestCase):
    def defined(self, text):
        return [(f.name, f.first, f.last) for f in cpp_text.read(text).functions if f.defined]

    def test_definitions_with_their_lines(self):
        self.assertEqual(self.defined(
            "namespace a::b {\nstruct C : D<int> {\n  C() : x_{1}, y_(2) {\n  }\n"
            "  int x_{f(1)};\n};\ntemplate <class T>\nvoid C::f(T t = {}) {\n  g({\"}\"});\n}\n"
            "}\n"),
            [("a::b::C::C", 3, 4), ("a::b::C::f", 7, 10)])

    def test_what_is_no_function(self):
        self.assertEqual(self.defined(
            "#define M(x) \\\n  void x() {}\nconst int a = f({1});\n"
            "auto l = [](int i) { return i; };\nenum class E { a, b };\n"
            "struct S { int n = 0; } s;\nconcept X = requires(T t) { t; };\n"
            "// void f() {}\nconst char* t = R\"(void g() {})\";\nint k{h(2)};\n"), [])

    def test_operators_and_types_with_calls_in_them(self):
        self.assertEqual([name for name, _, _ in self.defined(
            "bool operator==(A a, A b) { return true; }\n"
            "A& A::operator=(const A& a) { return *this; }\n"
            "std::function<void(int)> B<D>::f() { return {}; }\n"
            "C<D>::E C<D>::g() { return {}; }\n")],
            ["operator==", "A::operator=", "B::f", "C::g"])

    def test_parameters_in_one_form(self):
        declared = cpp_text.read("void f(const double* __restrict, std::array<int, 3>, int = 2);\n"
                                 "void f(const double* a, array<int, 3> b, const int n);\n")
        first, second = declared.functions
        self.assertEqual(first.parameters, second.parameters)

    def test_comments_are_joined_while_they_go_on(self):
        text = "// a\n// b\nint x;  // c\n        // d\n\n/* e */ \"// f\"\n"
        self.assertEqual(cpp_text.comments(text),
                         [(1, "a\nb"), (3, "c\nd"), (6, "e ")])


if __name__ == "__main__":
    unittest.main()
