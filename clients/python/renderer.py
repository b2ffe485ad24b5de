"""What renderers in Python share: their command line, the images that they write, and how they end."""
import argparse
import os
import sys

from exported_scene import BadInput


class Parser(argparse.ArgumentParser):
    """With what every renderer is told; its own settings are added to it."""

    def __init__(self, client, example=""):
        super().__init__(
            prog=f"clients/{client}/render", formatter_class=argparse.ArgumentDefaultsHelpFormatter,
            description="Writes the share of the light that arrives at each pixel, 1 = lit, as frame-<number>.pfm.",
            epilog=f"example: clients/{client}/render --scene exported --frames 59 --out images{example}")
        self.add_argument("--scene", required=True, help="folder that `shadowbench export` wrote")
        self.add_argument("--out", required=True, help="folder for the images")
        self.add_argument("--frames", help="numbers of frames, with commas; all of the scene if not given")

    def error(self, message):
        raise BadInput(f"{message}; --help names the options")


def write_frame(folder, frame, size, image):
    """A grey PFM, rows from the bottom; whole or not at all."""
    os.makedirs(folder, exist_ok=True)
    file = os.path.join(folder, f"frame-{frame['index']}.pfm")
    with open(file + ".part", "wb") as stream:
        stream.write(f"Pf\n{size[0]} {size[1]}\n{-1.0 if sys.byteorder == 'little' else 1.0}\n".encode())
        stream.write(image.tobytes())
    os.replace(file + ".part", file)


def run(client, render, words, errors=sys.stderr):
    """Ends the process with 2 where the renderer refuses what it was told."""
    try:
        render(words)
    except BadInput as error:
        print(f"{client}: {error}", file=errors, flush=True)
        sys.exit(2)
