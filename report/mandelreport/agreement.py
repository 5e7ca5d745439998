# SPDX-License-Identifier: Apache-2.0
"""Agreement of pictures: bytes, bits if there are EXR files, and FLIP against the canonical picture."""

from __future__ import annotations

import io
from dataclasses import dataclass

import numpy
from PIL import Image

from .pictures import Key, Picture, Studio

VISIBLE = 2  # of 255: larger differences of a byte are visible (core/image/compare.h)


@dataclass(frozen=True)
class Difference:
    """Difference of two pictures' bytes. `bits`: all bits of colour and depth are the same, too; None if not
    compared."""

    pixels: int
    differing: int
    visible: int
    largest: int
    psnr: float | None  # dB; None: infinite
    bits: bool | None

    @property
    def words(self) -> str:
        if self.differing == 0:
            return "same bits" if self.bits else "same bytes"
        return f"{self.differing:,} px, {self.visible:,} visibly, max {self.largest}"


def compare(studio: Studio, a: Picture, b: Picture) -> Difference:
    off = numpy.abs(a.bytes.astype(int) - b.bytes.astype(int))
    worst = off.max(axis=2)
    differing = int((worst > 0).sum())
    mean_square = float((off.astype(float) ** 2).mean())
    psnr = 10 * float(numpy.log10(255.0**2 / mean_square)) if mean_square > 0 else None
    exact = a.values is not None and b.values is not None and a.key.precision == b.key.precision
    bits = studio.same_bits(a, b) if exact and differing == 0 else None
    return Difference(worst.size, differing, int((worst > VISIBLE).sum()), int(worst.max()), psnr, bits)


def expected_picture(pictures: dict[Key, Picture], picture: Picture, reference: str) -> Picture | None:
    """Returns the expected picture: the reference's in the same mode, in double."""
    key = picture.key
    if key.backend == reference:
        return None
    return pictures.get(Key(key.fractal, "double", key.mode, reference))


def difference_map(a: Picture, b: Picture) -> bytes:
    """Returns a PNG: white where equal, darker for larger differences, black where a byte is off by 255. Every
    difference is at least as dark as a light grey and extends by a pixel all around, so that single pixels are
    visible."""
    worst = numpy.abs(a.bytes.astype(int) - b.bytes.astype(int)).max(axis=2)
    padded = numpy.pad(worst, 1)
    grown = numpy.max([padded[y : y + worst.shape[0], x : x + worst.shape[1]] for y in range(3) for x in range(3)], axis=0)
    level = numpy.where(grown == 0, 255, 190 * (255 - grown) // 255).astype(numpy.uint8)
    # 16 greys compress well.
    image = Image.fromarray(level).quantize(16)
    buffer = io.BytesIO()
    image.save(buffer, format="PNG", optimize=True)
    return buffer.getvalue()


def flip_mean(studio: Studio, canonical: Picture, picture: Picture) -> float | None:
    """Returns the mean of FLIP (Andersson et al., 2020) at its default viewing distance, or None if the package is
    missing."""
    try:
        import flip_evaluator  # pylint: disable=import-outside-toplevel
    except ImportError:
        return None

    def evaluate() -> float:
        to_float = [p.bytes.astype(numpy.float32) / 255 for p in (canonical, picture)]
        return float(flip_evaluator.evaluate(to_float[0], to_float[1], "LDR")[1])

    return studio.cache.value(evaluate, "flip 1.7", canonical.digest, picture.digest)


def encode(picture: Picture) -> bytes:
    """Returns the picture in a small lossless format."""
    buffer = io.BytesIO()
    Image.fromarray(picture.bytes).save(buffer, format="WEBP", lossless=True, quality=80, method=4)
    return buffer.getvalue()
