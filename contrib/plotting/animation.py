"""The deformed bodies of all steps as a film."""
import shutil
import subprocess

import numpy as np
from PIL import Image

from .bodies import BodyPicture
from .results import ResultsError
from .style import plt

MOST_FRAMES = 120


def draw(run, field, warp, is_raw, range_of_colours=None):
    """Writes bodies_FIELD.gif and, where ffmpeg is installed, bodies_FIELD.mp4; the paths. One range of colours, one window
    and one magnification for all frames; of more than MOST_FRAMES steps every n-th is drawn."""
    steps = sorted(run.body_files)
    if len(steps) < 2:
        raise ResultsError("--animate: fewer than two steps were written (Output/Fields every)")
    steps = steps[::-1][::-(-len(steps) // MOST_FRAMES)][::-1]
    last = BodyPicture(run, field, steps[-1], warp, is_raw)
    pictures = [BodyPicture(run, field, step, last.factor, is_raw) for step in steps]
    scale = range_of_colours or (min(p.limits[0] for p in pictures), max(p.limits[1] for p in pictures))
    box = np.min([p.deformed.min(axis=0) for p in pictures], axis=0), np.max([p.deformed.max(axis=0) for p in pictures], axis=0)
    frames = [image_of(picture.draw(scale, box)) for picture in pictures]
    # Layouts differ by a pixel or so with the length of labels.
    width, height = (min(frame.size[i] for frame in frames) // 2 * 2 for i in (0, 1))
    frames = [frame.crop((0, 0, width, height)) for frame in frames]
    path = run.directory / f"bodies_{field}.gif"
    palette = [frame.quantize(255, dither=Image.Dither.NONE) for frame in frames]
    palette[0].save(path, save_all=True, append_images=palette[1:], duration=max(40, 6000 // len(frames)), loop=0)
    return [path, *film(frames, run.directory / f"bodies_{field}.mp4")]


def image_of(figure):
    figure.canvas.draw()
    image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())).convert("RGB")
    plt.close(figure)
    return image


def film(frames, path):
    """The frames as MP4; nothing without ffmpeg."""
    if shutil.which("ffmpeg") is None:
        return []
    command = ["ffmpeg", "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", "{}x{}".format(*frames[0].size),
               "-r", str(min(25, max(2, len(frames) // 6))), "-i", "-", "-pix_fmt", "yuv420p", str(path)]
    done = subprocess.run(command, input=b"".join(frame.tobytes() for frame in frames), check=False)
    return [path] if done.returncode == 0 else []
