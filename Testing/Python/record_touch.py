"""Records the screen while a user touches a surface in the viewer, as an animated picture.

usage: record_touch.py SURFACE PICTURE.gif

A real window, a real mouse and real keys, as in the tests in this folder; needs Pillow. The README's
touch.gif is made by it, of the cortex.
"""

import sys
import threading
import time

from PIL import Image, ImageDraw, ImageFont, ImageGrab

from real_window import Desktop, skip_where_it_cannot_run

SIZE = 640, 440
PERIOD = 0.125  # [s] between two pictures
COLORS = 200
ARROW = ((0, 0), (0, 17), (4, 13), (7, 20), (10, 19), (7, 12), (12, 12))  # of the mouse [pixel]


class Recorder(threading.Thread):
    """Takes a picture of a window again and again, with the cursor and what the user does."""

    def __init__(self, desktop, program):
        super().__init__(daemon=True)
        self.display, self.program = desktop.environment["DISPLAY"], program
        desktop.xdo("mousemove", "--window", program.window, "--", 0, 0)
        place = desktop.xdo("getmouselocation", "--shell").split()  # X=..., Y=..., ...
        x, y = (int(word.split("=")[1]) for word in place[:2])
        self.box = (x, y, x + program.size[0], y + program.size[1])
        self.doing, self.pictures, self.is_over = "", [], False
        self.font = ImageFont.load_default()

    def run(self):
        begin = time.monotonic()
        while not self.is_over:
            self.pictures.append(self.picture())
            time.sleep(max(0.0, begin + len(self.pictures) * PERIOD - time.monotonic()))

    def picture(self):
        shot = ImageGrab.grab(bbox=self.box, xdisplay=self.display).convert("RGB")
        pen = ImageDraw.Draw(shot)
        x, y = (share * side for share, side in zip(self.program.cursor, self.program.size))
        pen.polygon([(x + a, y + b) for a, b in ARROW], fill="white", outline="black")
        if self.doing:
            pen.rectangle((x + 16, y + 18, x + 26 + 6 * len(self.doing), y + 34), fill=(30, 34, 44))
            pen.text((x + 21, y + 20), self.doing, font=self.font, fill="white")
        return shot


def use(desktop, program, recorder):
    """What the user does."""

    def drag(doing, x, y, seconds):
        recorder.doing = doing
        program.drag(x, y, seconds, int(20 * seconds))

    program.move(0.3, 0.62)
    recorder.start()
    drag("move", 0.4, 0.5, 1.0)
    desktop.xdo("keydown", "space")
    recorder.doing = "hold space"
    time.sleep(0.8)
    drag("space held: stroke", 0.62, 0.4, 2.2)
    recorder.doing = "wheel: deeper"
    for _ in range(3):
        desktop.xdo("click", "4")
        time.sleep(0.2)
    drag("space held: stroke", 0.45, 0.3, 1.6)
    desktop.xdo("keyup", "space")
    drag("let go", 0.4, 0.34, 0.6)
    desktop.xdo("mousedown", "1")
    drag("drag: turn", 0.6, 0.45, 1.2)
    desktop.xdo("mouseup", "1")
    drag("move", 0.5, 0.5, 0.6)
    recorder.is_over = True
    recorder.join()


def main(surface, path):
    skip_where_it_cannot_run()
    with Desktop() as desktop:
        program = desktop.start(
            [sys.executable, "-m", "vtkhaptics", surface, "--size", *map(str, SIZE)], seconds=120.0)
        program.engages(120.0)
        time.sleep(1.0)
        program.focus()
        recorder = Recorder(desktop, program)
        use(desktop, program, recorder)
        program.key("q")
        assert program.ended(60.0) == 0, program.output()
    strip = Image.new("RGB", (SIZE[0], 8 * SIZE[1]))  # of which the colours are taken
    for i in range(8):
        strip.paste(recorder.pictures[i * len(recorder.pictures) // 8], (0, i * SIZE[1]))
    palette = strip.quantize(COLORS, Image.Quantize.MAXCOVERAGE)  # the few red pixels as well
    pictures = [p.quantize(palette=palette, dither=Image.Dither.NONE) for p in recorder.pictures]
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=int(1000 * PERIOD),
                     loop=0, optimize=True)
    print(f"{path}: {len(pictures)} pictures")


main(*sys.argv[1:])
