"""Films, read back with Pillow and ffmpeg: the followed pivot is where the witness has it.

From the pictures alone a map from the linkage's plane to pixels is fitted.  A camera that stands
still with equal axes leaves one scale, no turn, and next to nothing over.
"""

import json
import shutil
import struct
import subprocess
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from burmester.errors import BurmesterError, InputError
from burmester.export.films import movie
from burmester.export.options import Options
from burmester.fourbar.dyad import PR, RP, RR
from burmester.fourbar.pose_error import PoseError
from burmester.tasks.motion_task import Task
from tests.oracles import witness
from tests.oracles.bodies import BODY, REGIONS, bodied, carried
from tests.oracles.saved_linkages import PAPER, paper, saved

imageio_ffmpeg = pytest.importorskip("imageio_ffmpeg", reason="films need imageio-ffmpeg")

SMALL = Options(seconds=1.2, frames_per_second=20, width_px=321)


def rocking():
    """A rail that drives, back and forth between its poses."""
    first, second = PR(0.4, 30.0, [15.0, -20]), RR([160.0, 60], [90.0, 10], 110.0)
    where, phi = witness.places(first, second, np.linspace(-35, 25, 5))
    rows = np.column_stack([where[0].real, where[0].imag, phi[0]])
    return saved(first, second, rows, unit="mm")


def slot():
    """A slot that drives."""
    first, second = RP([0.0, 0], 0.3, 1.0), RR([5.0, 1], [2.0, 1.5], 3.0)
    phi = np.linspace(0.7, 1.3, 4)
    where = witness.turned(first, second, phi)[0]
    return saved(first, second, np.column_stack([where.real, where.imag, phi]))


class Films:
    """The paper's linkage in full size as a GIF, and small films of others, made when asked for."""

    def __init__(self, folder):
        self.folder, self.paper, self.rocking, self.slot = folder, paper(), rocking(), slot()

    def __call__(self, name):
        path, (whose, to) = self.folder / name, name.split(".")
        if not path.exists():
            chosen = getattr(self, "paper" if whose == "small" else whose)
            options = Options() if name == "paper.gif" else SMALL
            getattr(movie, f"write_{to}")(chosen, path, options)
        return path


@pytest.fixture(scope="module")
def films(tmp_path_factory):
    return Films(tmp_path_factory.mktemp("films"))


def gif(path):
    """Pictures (rows, columns, 3), seconds each, and how often it is repeated (0: always)."""
    pictures, seconds = [], []
    with Image.open(path) as image:
        for k in range(image.n_frames):
            image.seek(k)
            seconds.append(image.info["duration"] / 1000)
            pictures.append(np.asarray(image.convert("RGB")))
        return pictures, np.array(seconds), image.info["loop"]


def mp4(path):
    """Pictures (rows, columns, 3), by ffmpeg as single files."""
    program = imageio_ffmpeg.get_ffmpeg_exe()
    out = path.with_suffix(".pictures")
    if not out.exists():
        out.mkdir()
        asked = [program, "-v", "error", "-i", str(path), str(out / "%04d.bmp")]
        subprocess.run(asked, check=True, timeout=60)
    return [np.asarray(Image.open(each).convert("RGB")) for each in sorted(out.iterdir())]


def yellow(picture):
    """The middle of what is yellow, column and row."""
    near = (picture[..., 0] > 190) & (picture[..., 1] > 180) & (picture[..., 2] < 130)
    rows, columns = np.nonzero(near)
    spot = np.hypot(rows - np.median(rows), columns - np.median(columns)) < 12
    assert spot.sum() > 20
    assert spot.mean() > 0.6  # the rest is single pixels beside lines
    return complex(columns[spot].mean(), rows[spot].mean())


def fitted(points, pixels):
    """Points a + b z in pixels, rows downwards: a, b, and what is left over."""
    z, w = np.array(points), np.conj(np.array(pixels))
    left = np.column_stack([np.ones_like(z), z])
    (a, b), *_ = np.linalg.lstsq(left, w, rcond=None)
    return a, b, abs(a + b * z - w)


def crank(count):
    """The crank's pin of the paper's linkage in each picture of a whole turn."""
    drive = 0.08 + 2 * np.pi * np.arange(count) / count
    return complex(*PAPER[0].fixed_pivot) + PAPER[0].radius * np.exp(1j * drive)


def straight(points, pixels, limit=0.4):
    """One scale in both directions, not turned, and nothing left over."""
    _, b, rest = fitted(points, pixels)
    assert abs(np.angle(b)) < 3e-3
    assert rest.max() < limit
    z, w = np.array(points), np.conj(np.array(pixels))
    for part in (np.real, np.imag):
        slope = np.polyfit(part(z), part(w), 1)[0]
        assert slope == pytest.approx(abs(b), rel=5e-3)


def test_gif_of_a_crank_goes_round_once(films):
    pictures, seconds, loop = gif(films("small.gif"))
    assert loop == 0
    assert seconds.sum() == pytest.approx(1.2)
    assert len(pictures) == 24
    assert all(picture.shape[1] == 320 for picture in pictures)  # even, as an MP4 has it
    straight(crank(24), [yellow(picture) for picture in pictures])


def test_gif_of_the_paper_is_small(films):
    assert films("paper.gif").stat().st_size < 2e6
    with Image.open(films("paper.gif")) as image:
        assert image.n_frames == 100
        assert image.width == Options().width_px


def test_the_path_grows_and_nothing_leaves_the_picture(films):
    pictures, _, _ = gif(films("small.gif"))
    a, b, _ = fitted(crank(24), [yellow(picture) for picture in pictures])
    drive = 0.08 + 2 * np.pi * np.arange(24) / 24
    where, phi = (each[1] for each in witness.places(*PAPER, drive))
    height, width, _ = pictures[0].shape
    for dyad in PAPER:
        pin = where + np.exp(1j * phi) * complex(*dyad.moving_pivot)
        for z in (pin, complex(*dyad.fixed_pivot)):
            at = np.conj(a + b * np.atleast_1d(z))
            assert at.real.min() > 60
            assert at.real.max() < width - 10
            assert at.imag.min() > 30
            assert at.imag.max() < height - 45

    def blue(picture, z):
        column, row = (round(v) for v in (z.real, z.imag))
        near = picture[row - 2 : row + 3, column - 2 : column + 3].astype(int)
        return bool(((near[..., 2] > near[..., 0] + 90) & (near[..., 0] < 90)).any())

    at = np.conj(a + b * where)
    # A point of the path is drawn once it has been passed, and not before.
    for k in (4, 8, 15, 20):
        assert blue(pictures[23], at[k])
        assert not blue(pictures[0], at[k])


@pytest.mark.parametrize("to", ["gif", "mp4"])
def test_the_body_moves_with_the_linkage_amid_its_surroundings(films, tmp_path, to):
    around, chosen = bodied(), films.paper
    task = replace(chosen.task, body=around.body, surroundings=around.surroundings)
    path, larger = tmp_path / f"out.{to}", replace(SMALL, width_px=640)
    getattr(movie, f"write_{to}")(replace(chosen, task=task), path, larger)
    getattr(movie, f"check_{to}")(replace(chosen, task=task), path, larger)
    pictures = gif(path)[0] if to == "gif" else mp4(path)
    pins = [yellow(picture) for picture in pictures]
    a, b, rest = fitted(crank(24), pins)
    assert rest.max() < 0.5
    drive = 0.08 + 2 * np.pi * np.arange(24) / 24
    where, phi = (each[1] for each in witness.places(*PAPER, drive))
    rings = carried(BODY, where.real, where.imag, phi) @ [1, 1j]
    shares = np.linspace(0.1, 0.9, 9)[:, None]
    edges = (rings[:, None] + shares * (np.roll(rings, -1, axis=1) - rings)[:, None]).reshape(
        24, -1
    )
    height, width, _ = pictures[0].shape

    def green(picture, z):
        column, row = (round(float(v)) for v in (z.real, z.imag))
        near = picture[row - 2 : row + 3, column - 2 : column + 3].astype(int)
        strong = (near[..., 1] > near[..., 0] + 90) & (near[..., 0] < 110)
        return bool(strong.any())

    for corners in (rings, *(np.array(each) @ [1, 1j] for each, _ in REGIONS)):
        at = np.conj(a + b * corners)
        assert at.real.min() > 50
        assert at.real.max() < width
        assert at.imag.min() > 25
        assert at.imag.max() < height - 35
    here, gone = [], []
    for k in range(0, 24, 4):
        at = np.conj(a + b * edges[k])
        here += [green(pictures[k], z) for z in at]
        gone += [green(pictures[(k + 12) % 24], z) for z in at]
    # Links and pivots lie over some of it; half a turn later it, or the body at a pose, crosses it.
    assert np.mean(here) > 0.9
    assert np.mean(gone) < np.mean(here) - 0.3


def test_mp4_of_a_crank(films):
    pictures = mp4(films("paper.mp4"))
    assert len(pictures) == 24
    assert pictures[0].shape[1] == 320  # even
    assert pictures[0].shape[0] % 2 == 0
    straight(crank(24), [yellow(picture) for picture in pictures], 0.6)


def test_back_and_forth(films):
    """From the first pose to the last, and back the same way."""
    rail = films.rocking.linkage.first
    of_gif, times, _ = gif(films("rocking.gif"))
    of_mp4 = mp4(films("rocking.mp4"))
    for name, pictures, seconds in (("gif", of_gif, times), ("mp4", of_mp4, np.full(24, 0.05))):
        seen = np.array([yellow(picture) for picture in pictures])
        way = np.exp(1j * float(rail.normal_angle)) * 1j
        along = (np.conj(seen) * np.conj(way)).real
        across = (np.conj(seen) * np.conj(way)).imag
        assert np.ptp(across) < 1.0, name
        turn = int(along.argmax())
        assert (np.diff(along[: turn + 1]) > -0.3).all(), name
        assert (np.diff(along[turn:]) < 0.3).all(), name
        assert seconds[:turn].sum() == pytest.approx(0.6, abs=0.1), name
        assert seconds.sum() == pytest.approx(1.2), name
        assert abs(seen[0] - seen[-1]) < 3, name


def test_scale_of_back_and_forth(films, tmp_path, monkeypatch):
    """The rail's pin travels 60 mm between two fixed things of which one is the other pivot."""
    pictures = mp4(films("rocking.mp4"))
    seen = np.array([yellow(picture) for picture in pictures])
    # The frame's ticks: both axes have the same pixels for a millimetre.
    figures = []

    def kept(*size, figure=movie.plot.figure):
        figures.append(figure(*size))
        return figures[-1]

    monkeypatch.setattr(movie.plot, "figure", kept)
    movie.write_mp4(films.rocking, tmp_path / "again.mp4", SMALL)
    drawn = figures[-1].axes[0].transData
    (x0, y0), (x1, y1) = drawn.transform([(0, 0), (60, 60)])
    assert x1 - x0 == pytest.approx(y1 - y0, rel=1e-9)
    assert np.ptp(abs(seen - seen[0])) == pytest.approx(x1 - x0, abs=1.5)


def test_a_slot_that_drives(films):
    """The body's origin is followed; it starts at the first pose and turns back at the last."""
    pictures, _, _ = gif(films("slot.gif"))
    seen = np.array([yellow(picture) for picture in pictures])
    phi = np.linspace(0.7, 1.3, 400)
    where = witness.turned(films.slot.linkage.first, films.slot.linkage.second, phi)[0]
    # Where each of the pictures is on the way is not told: only that it is on it, in order.
    last = len(pictures) // 2
    a, b, _ = fitted(where[[0, -1]], seen[[0, last]])
    way = np.conj(a + b * where)
    away = abs(seen[:, None] - way)
    assert away.min(axis=1).max() < 1.5
    assert (np.diff(away.argmin(axis=1)[: last + 1]) >= 0).all()


def boxes(data):
    """The names of an MP4's outermost boxes in their order."""
    at, names = 0, []
    while at < len(data):
        size, name = struct.unpack_from(">I4s", data, at)
        names.append(name.decode())
        at += size
    return names


def test_mp4_starts_at_once(films):
    names = boxes(films("paper.mp4").read_bytes())
    assert names.index("moov") < names.index("mdat")


@pytest.mark.skipif(shutil.which("ffprobe") is None, reason="ffprobe is not installed")
def test_ffprobe(films):
    asked = ["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json"]
    said = subprocess.run(
        [*asked, str(films("paper.mp4"))], capture_output=True, check=True, timeout=60
    )
    (stream,) = json.loads(said.stdout)["streams"]
    assert stream["codec_name"] == "h264"
    assert stream["pix_fmt"] == "yuv420p"
    assert stream["nb_read_frames"] == "24"
    assert stream["avg_frame_rate"] == "20/1"
    assert float(stream["duration"]) == pytest.approx(1.2)


def refused(check, chosen, path, options):
    with pytest.raises(BurmesterError) as caught:
        check(chosen, path, options)
    assert caught.value.code == "E160"
    return caught.value.why


def test_own_films_pass(films):
    movie.check_gif(films.paper, films("paper.gif"), Options())
    movie.check_mp4(films.paper, films("paper.mp4"), SMALL)
    movie.check_gif(films.rocking, films("rocking.gif"), SMALL)
    movie.check_mp4(films.rocking, films("rocking.mp4"), SMALL)
    movie.check_gif(films.slot, films("slot.gif"), SMALL)


def test_other_films_are_refused(films, tmp_path):
    longer = Options(seconds=2.4, frames_per_second=20, width_px=321)
    slower = Options(seconds=2.4, frames_per_second=10, width_px=321)
    assert "lasts" in refused(movie.check_gif, films.rocking, films("rocking.gif"), longer)
    assert "pictures" in refused(movie.check_mp4, films.rocking, films("rocking.mp4"), longer)
    assert "a second" in refused(movie.check_mp4, films.rocking, films("rocking.mp4"), slower)
    # The same film played backwards, from its second picture on.
    pictures, _, _ = gif(films("small.gif"))
    path = tmp_path / "x.gif"

    def check_changed(pictures, **more):
        frames = [Image.fromarray(picture.astype(np.uint8)) for picture in pictures]
        frames[0].save(path, save_all=True, append_images=frames[1:], duration=50, **more)
        return refused(movie.check_gif, films.paper, path, SMALL)

    assert "driver is" in check_changed([pictures[0], *pictures[:0:-1]], loop=0)
    # Two pixels aside.
    aside = [np.roll(picture, 2, axis=1) for picture in pictures]
    assert "pixels off" in check_changed(aside, loop=0)
    assert "once" in check_changed(pictures)


@pytest.mark.parametrize(
    ("options", "help"),
    [
        ({"width_px": 0}, "give --pixels 100"),
        ({"width_px": 10**9}, "give --pixels 4096"),
        ({"seconds": 0.0}, "give --seconds 0.1"),
        ({"seconds": np.nan}, "give --seconds 0.1"),
        ({"seconds": np.inf}, "give --seconds 600"),
        ({"frames_per_second": 0.0}, "give --fps 1"),
        ({"frames_per_second": np.nan}, "give --fps 1"),
        ({"seconds": 60.0, "width_px": 1000}, "give --pixels 284, or fewer --seconds"),
        ({"seconds": 600.0, "frames_per_second": 240.0}, "give --seconds 83.3, or fewer"),
    ],
)
def test_a_film_that_cannot_be_drawn_is_refused_before_it_is(tmp_path, options, help):
    write = movie.write_mp4 if "frames_per_second" in options else movie.write_gif
    with pytest.raises(InputError) as caught:
        write(paper(), tmp_path / "a.gif", Options(**options))
    assert caught.value.code == "E162"
    assert caught.value.help.startswith(help)


def test_of_very_many_poses_some_are_drawn(tmp_path, monkeypatch):
    """All of them would hide the linkage, and take an hour; the outermost are among them."""
    drawn, real = [], movie.plot.poses

    def poses_drawn(ax, poses, **how):
        drawn.append(poses)
        return real(ax, poses, **how)

    monkeypatch.setattr(movie.plot, "poses", poses_drawn)
    chosen = paper()
    poses = chosen.task.poses
    many = poses[np.repeat(np.arange(len(poses.angle)), 300)]
    chosen = replace(chosen, task=Task(many), error=PoseError.of(chosen.linkage, many, 1.0))
    movie.write_gif(chosen, tmp_path / "a.gif", SMALL)
    assert max(len(each.angle) for each in drawn) <= 60
    ends = np.stack([poses.translation.min(axis=0), poses.translation.max(axis=0)])
    shown = drawn[0].translation
    assert np.array_equal(np.stack([shown.min(axis=0), shown.max(axis=0)]), ends)
    movie.check_gif(chosen, tmp_path / "a.gif", SMALL)
