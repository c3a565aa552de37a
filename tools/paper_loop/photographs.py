"""Photographs of the ruler, calculated: a pinhole camera in the head over a face with rulings from
end to end. The camera is turned about its sight so that the ruler lies level in its images."""

import math
import struct
import zlib

import head

WIDTH, HEIGHT = 320, 96  # [px]
FOCAL = 300  # [px]
PITCH, LINE = 6e-3, 1.6e-3  # [m] between rulings, width of one
PAPER, INK = 0.75, 0.15  # of full scale
BLUR = 0.8  # [px]
NOISE = 0.01  # of full scale
SHADE = 0.3  # of the light, from left to right


def camera_turn(poses):
    """[rad] about the sight that lays the ruler level in the mean of an edge's poses X_EQ."""
    ruler = [pose.turn[0] for pose in poses]  # E's x axis in the tool's axes
    return math.atan2(sum(x[1] for x in ruler), sum(x[0] for x in ruler))


def places(X_EQ, turn, moved):
    """[m] of the ruler that each pixel sees, by rows; `moved`: of the camera along the ruler."""
    eye = X_EQ.point(head.CAMERA)
    begin = head.RULER_BEGINS + eye[0] + moved
    c, s = math.cos(turn), math.sin(turn)
    (xx, xy, xz), (zx, zy, zz) = X_EQ.turn[0], X_EQ.turn[2]
    # By pixel to the right, by pixel down, straight on: along the ruler, and out of the face.
    right = (xx * c + xy * s) / FOCAL, (zx * c + zy * s) / FOCAL
    down = (-xx * s + xy * c) / FOCAL, (-zx * s + zy * c) / FOCAL
    for v in range(HEIGHT):
        down_v = v - (HEIGHT - 1) / 2
        x0, z0 = xz + down[0] * down_v, zz + down[1] * down_v
        steps = [u - (WIDTH - 1) / 2 for u in range(WIDTH)]
        yield [begin - eye[2] * (x0 + right[0] * u) / (z0 + right[1] * u) for u in steps]


def brightness(place, blur):
    """Of the face at a place, a ruling's flanks blurred by a Gaussian [m]."""
    off = place - PITCH * round(place / PITCH)
    wide = math.sqrt(2) * blur
    ink = 0.5 * (math.erf((off + LINE / 2) / wide) - math.erf((off - LINE / 2) / wide))
    return PAPER + (INK - PAPER) * ink


def photograph(X_EQ, turn, moved, rng):
    """Rows of bytes."""
    seen = list(places(X_EQ, turn, moved))
    middle = HEIGHT // 2
    along = (seen[middle][-1] - seen[middle][0]) / (WIDTH - 1)
    across = (seen[-1][WIDTH // 2] - seen[0][WIDTH // 2]) / (HEIGHT - 1)
    blur = math.hypot(BLUR, 1 / math.sqrt(12)) * math.hypot(along, across)  # and a pixel's square
    light = [255 * (1 - SHADE * u / WIDTH) for u in range(WIDTH)]
    noise = [255 * NOISE * rng.gauss(0, 1) for _ in range(997)]  # enough to seem without end
    rows = []
    for row in seen:
        start = rng.randrange(len(noise))
        rows.append(bytes(
            round(light[u] * brightness(place, blur) + noise[(start + u) % len(noise)])
            for u, place in enumerate(row)))
    return rows


def png(rows):
    """A greyscale PNG file."""
    def chunk(kind, content):
        crc = zlib.crc32(kind + content)
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", crc)
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
            + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows), 1))
            + chunk(b"IEND", b""))
