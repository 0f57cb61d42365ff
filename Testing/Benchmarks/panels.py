"""Panels of charts drawn with VTK's own charts (vtkChartXY), several next to each other.

Logarithms are taken here and the ticks are set here, so that a chart looks alike whatever the data.
"""

import math
import pathlib
import sys

import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401  (registers the 2D painter)
import vtkmodules.vtkRenderingFreeType  # noqa: F401  (registers the fonts)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (registers the render window)
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartLegend, vtkChartXY
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkRectf, vtkTable
from vtkmodules.vtkRenderingContext2D import vtkContextActor, vtkPen
from vtkmodules.vtkRenderingCore import (
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)

# Needs no build.
sys.path.append(str(pathlib.Path(__file__).parents[2] / "Interactors/Python/vtkhaptics"))
from output import write_png  # noqa: E402

INK = (40, 40, 40)
GRID = (225, 225, 225)
SOLID, DASHED = vtkPen.SOLID_LINE, vtkPen.DASH_LINE
CROSS, CIRCLE, SQUARE, DIAMOND = 1, 4, 3, 5  # vtkPlotPoints' marker styles
FONT = 15


def array(name, values):
    result = vtkDoubleArray()
    result.SetName(name)
    for value in values:
        result.InsertNextValue(value)
    return result


class Scale:
    """An axis' range and ticks. Ticks: {value: label}; values at a log scale are true values."""

    def __init__(self, title, low, high, ticks, log=False):
        self.title, self.log = title, log
        self.low, self.high = self.of(low), self.of(high)
        self.ticks = ticks

    def of(self, value):
        return math.log10(value) if self.log else value

    def clamped(self, value):
        if self.log and value <= 0.0:
            return self.low
        return min(max(self.of(value), self.low), self.high)


class Panel:
    """One chart. Data are true values; what is out of range is drawn at the rim, as a floor is."""

    def __init__(self, x, y, title="", legend=False):
        self.x, self.y = x, y
        self.notes = []
        self.tables = []
        self.chart = vtkChartXY()
        self.chart.SetAutoSize(False)
        self.chart.SetTitle(title)
        self.chart.GetTitleProperties().SetFontSize(FONT + 1)
        self.chart.GetTitleProperties().SetColor(*(c / 255.0 for c in INK))
        self.chart.SetBorders(10, 10, 10, 10)
        for scale, side in ((x, vtkAxis.BOTTOM), (y, vtkAxis.LEFT)):
            self._prepare(self.chart.GetAxis(side), scale)
        self.chart.SetShowLegend(legend)
        key = self.chart.GetLegend()
        key.SetInline(False)
        key.SetHorizontalAlignment(vtkChartLegend.RIGHT)
        key.SetVerticalAlignment(vtkChartLegend.TOP)
        key.SetLabelSize(FONT - 1)
        key.GetPen().SetColor(255, 255, 255, 255)

    @staticmethod
    def _prepare(axis, scale):
        axis.SetTitle(scale.title)
        axis.SetBehavior(vtkAxis.FIXED)
        axis.SetRange(scale.low, scale.high)
        positions, labels = array("positions", []), vtkStringArray()
        for value, label in scale.ticks.items():
            positions.InsertNextValue(scale.of(value))
            labels.InsertNextValue(label)
        axis.SetCustomTickPositions(positions, labels)
        axis.GetGridPen().SetColor(*GRID)
        axis.GetLabelProperties().SetFontSize(FONT - 1)
        axis.GetTitleProperties().SetFontSize(FONT)
        axis.GetTitleProperties().SetBold(False)

    def _add(self, kind, points, name):
        table = vtkTable()
        table.AddColumn(array("x", [self.x.clamped(x) for x, _ in points]))
        table.AddColumn(array(name, [self.y.clamped(y) for _, y in points]))
        self.tables.append(table)
        plot = self.chart.AddPlot(kind)
        plot.SetInputData(table, 0, 1)
        plot.SetLegendVisibility(bool(name.strip()))
        return plot

    def line(self, points, colour, name=" ", width=2.0, pen=SOLID):
        if len(points) > 1:
            plot = self._add(vtkChart.LINE, points, name)
            plot.SetColor(*colour, 255)
            plot.SetWidth(width)
            plot.GetPen().SetLineType(pen)

    def markers(self, points, colour, name=" ", size=9.0, style=CIRCLE, hollow=False):
        """Filled markers, or rings."""
        for part, shade in ((size, colour), (0.6 * size, (255, 255, 255))):
            if points and (part == size or hollow):
                plot = self._add(vtkChart.POINTS, points, name if part == size else " ")
                plot.SetColor(*shade, 255)
                plot.SetMarkerStyle(style)
                plot.SetMarkerSize(part)

    def rule_x(self, value, label):
        """A dashed line across at a value of x, with its label at the top."""
        low, high = (10.0**v if self.y.log else v for v in (self.y.low, self.y.high))
        self.line([(value, low), (value, high)], (150, 150, 150), width=1.5, pen=DASHED)
        self.note(value, high, label, (110, 110, 110), dx=4, dy=-16)

    def rule_y(self, value, label, at=None):
        """A dashed line along at a value of y, with its label at the left or at a value of x."""
        low, high = (10.0**v if self.x.log else v for v in (self.x.low, self.x.high))
        self.line([(low, value), (high, value)], (150, 150, 150), width=1.5, pen=DASHED)
        self.note(at or low, value, label, (110, 110, 110), dx=5, dy=4)

    def note(self, x, y, text, colour=INK, dx=8, dy=-5, size=FONT - 2):
        self.notes.append((self.x.clamped(x), self.y.clamped(y), text, colour, dx, dy, size))

    def actors(self):
        """The notes as text, placed where the drawn axes are: after a first rendering."""
        bottom, left = self.chart.GetAxis(vtkAxis.BOTTOM), self.chart.GetAxis(vtkAxis.LEFT)
        x0, x1 = bottom.GetPoint1()[0], bottom.GetPoint2()[0]
        y0, y1 = left.GetPoint1()[1], left.GetPoint2()[1]
        for x, y, text, colour, dx, dy, size in self.notes:
            actor = vtkTextActor()
            actor.SetInput(text)
            actor.GetTextProperty().SetFontSize(size)
            actor.GetTextProperty().SetColor(*(c / 255.0 for c in colour))
            actor.SetPosition(
                x0 + (x - self.x.low) / (self.x.high - self.x.low) * (x1 - x0) + dx,
                y0 + (y - self.y.low) / (self.y.high - self.y.low) * (y1 - y0) + dy)
            yield actor


def draw(panels, file, width, height, shares=None):
    """Draws the panels from left to right, each with its share of the width, into a PNG file."""
    shares = shares or [1.0 / len(panels)] * len(panels)
    actor, renderer, window = vtkContextActor(), vtkRenderer(), vtkRenderWindow()
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.AddViewProp(actor)
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(8)
    window.SetSize(width, height)
    window.AddRenderer(renderer)
    actor.GetScene().SetRenderer(renderer)
    left = 0.0
    for panel, share in zip(panels, shares):
        panel.chart.SetSize(vtkRectf(left, 0.0, share * width, height))
        actor.GetScene().AddItem(panel.chart)
        left += share * width
    window.Render()
    for panel in panels:
        for note in panel.actors():
            renderer.AddViewProp(note)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.SetInputBufferTypeToRGB()
    image.ReadFrontBufferOff()
    image.Update()
    write_png(file, image.GetOutput())
    window.Finalize()
