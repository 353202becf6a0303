"""The words that stand above columns, in seven languages, and the units beside them.

Capitals, accents, hyphens, dots and underscores do not count: `X-Koordinate` is `x koordinate`.
A unit stands behind its word: `x_mm`, `x mm`, `x (mm)`, `x [mm]`, `x/mm`, `x in mm`, `Winkel °`.
"""

from __future__ import annotations

import functools
import re
import unicodedata
from typing import NamedTuple

from burmester.io.reading.pose_table import PAIR, POINTS

IGNORED = ""  # the role of a column that is left alone
MAX_NAME_CHARACTERS = 60  # characters of a name; a longer one is not compared with known ones

# The words of each role as people write them: in English, German, French, Spanish, Italian,
# Chinese and Japanese.
WORDS: dict[str, str] = {
    "x": "x, x coordinate, coordinate x, x coord, x position, position x, pos x, x pos, x value, "
    "X-Koordinate, Koordinate X, X-Wert, Position X, abscisse, coordonnée X, position en X, "
    "coordenada X, posición X, coordinata X, posizione X, X坐标, X坐標, X座標, X位置",
    "angle": "angle, theta, phi, psi, alpha, rotation, orientation, yaw, rot, rz, rot z, θ, φ, ψ, "
    "α, Winkel, Drehwinkel, Verdrehwinkel, Verdrehung, Drehung, Orientierung, Drehlage, "
    "angle de rotation, ángulo, ángulo de giro, ángulo de rotación, rotación, giro, orientación, "
    "angolo, angolo di rotazione, rotazione, orientamento, 角度, 角, 旋转角, 旋转角度, 旋轉角, "
    "转角, 轉角, 姿态角, 回転角, 回転角度, 回転, 姿勢角",
    "weight": "weight, Gewicht, Gewichtung, poids, pondération, peso, ponderación, ponderazione, "
    "权重, 權重, 重み",
    "name": "name, pose, label, point, position, pos, Punkt, Punktname, Pkt, Stellung, Lage, "
    "Bezeichnung, Benennung, nom, repère, désignation, étiquette, nombre, punto, posición, "
    "etiqueta, nome, posa, posizione, etichetta, 名称, 名稱, 名前, 名字, 点, 點, 点名, 位姿, 姿态, "
    "姿勢, 位置",
    "number": "no, nr, #, number, point no, pose no, Nummer, lfd. Nr, Punkt-Nr, Punktnummer, "
    "numéro, num, n°, n.°, número, numero, 编号, 編號, 序号, 點號, 点号, 番号, 点番号",
    "cos": "cos, cosine, cos angle, cos theta, cos phi, cos θ, cos φ, Kosinus, coseno, cosinus",
    "sin": "sin, sine, sin angle, sin theta, sin phi, sin θ, sin φ, Sinus, seno",
    "exact": "exact",
    "crank": "crank, crank angle, drive, drive angle, driver angle, input, input angle, Kurbel, "
    "Kurbelwinkel, Antriebswinkel, manivelle, angle de manivelle, manivela, ángulo de manivela, "
    "manovella, angolo di manovella, 曲柄, 曲柄角, クランク, クランク角",
    "output": "output, output angle, Abtrieb, Abtriebswinkel, sortie, salida, uscita",
    "time": "time, t, Zeit, temps, tiempo, tempo, 时间, 時間, 時刻",
    "frame": "frame, index, __index_level_0__, Bild, image, fotograma, 帧, フレーム",
    "remark": "remark, remarks, comment, comments, Bemerkung, Bemerkungen, Kommentar, Anmerkung, "
    "remarque, commentaire, observaciones, comentario, osservazioni, commento, 备注, 備註, 備考",
}
WORDS["y"] = WORDS["x"].replace("x", "y").replace("X", "Y").replace("abscisse", "ordonnée")
WORDS["z"] = WORDS["x"].replace("x", "z").replace("X", "Z").replace("abscisse", "cote")
_TOLERANCE = "tol {0}, {0} tol, tolerance {0}, {0} tolerance, Toleranz {0}, {0} Toleranz, ±{0}, "
_TOLERANCE += "tolérance {0}, tolleranza {0}, tolerancia {0}, {0} 公差"
WORDS |= {f"tol_{part}": _TOLERANCE.format(part) for part in ("x", "y", "angle")}
WORDS["tol_angle"] += ", Winkeltoleranz, Toleranz Winkel"
WORDS |= {"tol_axes": "tol axes, tolerance axes", "free": "free, frei, libre, libero"}
WORDS |= {point: point for point in POINTS}

_LENGTHS: dict[str, str] = {
    "um": "um, µm, micrometer, micrometre, Mikrometer",
    "mm": "mm, millimeter, millimeters, millimetre, millimetres, millimètres, milímetros, "
    "millimetri, 毫米, ミリ, ミリメートル",
    "cm": "cm, centimeter, centimeters, centimetre, centimetres, Zentimeter, centimètres, "
    "centímetros, centimetri, 厘米, センチ, センチメートル",
    "m": "m, meter, meters, metre, metres, mètres, metros, metri, 米, メートル",
    "in": "in, inch, inches, Zoll, pouce, pouces, pulgada, pulgadas, pollice, pollici, "
    "英寸, インチ",
    "ft": "ft, foot, feet",
    "px": "px, pixel, pixels",
}
_ANGLES: dict[str, str] = {
    "deg": "deg, degree, degrees, °, degré, degrés, grado, grados, gradi, 度",
    "rad": "rad, radian, radians, Bogenmaß, radiant, radiante, radianes, radianti, 弧度, ラジアン",
}
LENGTHS = {word.lower(): unit for unit, text in _LENGTHS.items() for word in text.split(", ")}
_TIMES = {"s": "s, sec, second, seconds, 秒", "ms": "ms, milliseconds", "min": "min"}
_GRAD = ("grad", "altgrad")  # degrees in German; in English a grad is a gon
_GERMAN = ("winkel", "drehung", "verdrehung", "orientierung", "drehlage")  # ends of German words

UNITS = _LENGTHS | _ANGLES | _TIMES  # the words of each unit

_PLAIN = str.maketrans({"º": "°", "˚": "°", "″": '"', "”": '"'})
# A word and its unit, in a name without accents and capitals.
_WITH_UNIT = re.compile(
    r"(?P<word>.*?[^\s/(\[<])\s*(?:\(\s*([^()]+?)\s*\)|\[\s*([^\[\]]+?)\s*\]|<\s*([^<>]+?)\s*>"
    r"|/\s*([^/\s]+)|(?<=\w)(°)|[\s,]\s*(?:in |en )?([^\s,/()\[\]<>]+))"
)


class Word(NamedTuple):
    """What a name says of its column."""

    role: str
    unit: str | None
    word: str  # without the unit
    units: tuple[str, ...]  # that may stand beside it


def known(name: str) -> Word | None:
    """The role and the unit that a name states; the unit is "?" if it is no unit of the role.

    None is for a name that is not known.
    """
    if not name.strip() or (name.strip().startswith("#") and name.strip() != "#"):
        return Word(IGNORED, None, "#", ())
    if len(name) > MAX_NAME_CHARACTERS:
        return None
    words, plain = _words(), _plain(name)
    if role := words.get(plain):
        return Word(role, None, plain, tuple(_units(role)))
    found = _WITH_UNIT.fullmatch(plain)
    if not found or not (role := words.get(found["word"])) or not _units(role):
        return None
    text = next(filter(None, found.groups()[1:]))
    unit = unit_of(text, role) or "?"
    if role == "angle" and text in _GRAD and found["word"].endswith(_GERMAN):
        unit = "deg"
    return Word(role, unit, found["word"], tuple(_units(role)))


def unit_of(text: str, role: str) -> str | None:
    """The unit that a text says of a column of this role, or None."""
    plain = _plain(text)
    return next((unit for unit, words in _units(role).items() if plain in words), None)


@functools.cache
def _words() -> dict[str, str]:
    """The role of every plain word."""
    return {_plain(word): role for role, text in WORDS.items() for word in text.split(", ")}


@functools.cache
def _units(role: str) -> dict[str, tuple[str, ...]]:
    """The plain words of each unit that a role may have."""
    tables = {"angle": _ANGLES, "tol_angle": _ANGLES, "time": _TIMES}
    tables |= dict.fromkeys(PAIR, _ANGLES)
    tables |= dict.fromkeys(("x", "y", "z", "tol_x", "tol_y", *POINTS), _LENGTHS)
    return {
        unit: tuple(map(_plain, text.split(", "))) for unit, text in tables.get(role, {}).items()
    }


def _plain(name: str) -> str:
    """A name without capitals and accents, with single blanks for hyphens, dots and underscores."""
    parts = unicodedata.normalize("NFKD", name.translate(_PLAIN))
    letters = "".join(c for c in parts if unicodedata.category(c) != "Mn").casefold()
    return " ".join(re.sub(r"[\s_.:\u2010-\u2015-]+", " ", letters).split())
