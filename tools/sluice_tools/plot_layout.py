"""Figures of several panels with one head, and room for every text."""
from . import style


def panel_grid(count):
    columns = 1 if count == 1 else 2 if count <= 4 else 3
    return -(-count // columns), columns


class Panels:
    """A figure with a grid of panels and a head."""

    def __init__(self, plt, rows, columns, width, height, given):
        size = given.size or (width * columns, height * rows + 0.3)
        self.fig, axes = plt.subplots(rows, columns, squeeze=False, figsize=size)
        self.axes, self.columns = axes, columns

    def finish(self, head, used):
        """Hides what is not used, and keeps all titles within their panels."""
        for ax in self.axes.flat[used:]:
            ax.set_visible(False)
        width = self.fig.get_figwidth()
        title = self.fig.suptitle(head, x=0.01, ha="left", fontsize=11)
        style.fit_text(title, 0.97 * width)
        for ax in self.axes.flat[:used]:
            for loc in ("left", "center"):
                text = {"left": ax._left_title, "center": ax.title}[loc]
                if text.get_text():
                    style.fit_text(text, width / self.columns - 0.75)
        return self.fig
