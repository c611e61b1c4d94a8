"""A made-up linear axis that goes there and back, and its tracks as a story holds them."""

import array
import base64
import math
import random


def series(values, step, bucket=1, start=0.0):
    """Values (None: no value) as int16 between their least and most, `bucket` of them in one."""
    low, high = values, None
    if bucket > 1:
        groups = [values[i : i + bucket] for i in range(0, len(values), bucket)]
        low = [min(present(g), default=None) for g in groups]
        high = [max(present(g), default=None) for g in groups]
    known = present(low) + present(high or [])
    least, most = min(known), max(known)
    offset, scale = (least + most) / 2, (most - least) / 65534 or 1.0
    code = lambda track: base64.b64encode(
        array.array(
            "h", (-32768 if v is None else round((v - offset) / scale) for v in track)
        ).tobytes()
    ).decode()
    return {
        "start_s": start,
        "step_s": step * bucket,
        "count": len(low),
        "bucket": bucket,
        "offset": offset,
        "scale": scale,
        "low": code(low),
        "high": code(high) if high else None,
    }


def present(values):
    return [v for v in values if v is not None]


def move(rows, step):
    """Position, velocity and acceleration of a there-and-back move with cruise, m and s."""
    position, velocity, out = 0.0, 0.0, []
    for k in range(rows):
        phase = (k * step) % 6.24
        sign = 1 if phase < 3.12 else -1
        part = phase % 3.12
        a = sign * (0.6 if part < 0.2 else -0.6 if 2.0 <= part < 2.2 else 0.0)
        velocity += a * step
        position += velocity * step
        out.append((position, velocity, a))
    return zip(*out)


def bins_of(x, y, unit, variable, count=12):
    least, most = min(x), max(x)
    width = (most - least) / count or 1
    held = [[] for _ in range(count)]
    for xi, yi in zip(x, y):
        held[min(count - 1, int((xi - least) / width))].append(yi)
    total = sum(v * v for v in y) or 1
    bins = []
    for k, ys in enumerate(held):
        mean = sum(ys) / len(ys) if ys else None
        std = math.sqrt(sum((v - mean) ** 2 for v in ys) / len(ys)) if ys else None
        bins.append(
            {
                "from": least + k * width,
                "to": least + (k + 1) * width,
                "mean": mean,
                "std": std,
                "residual_share": sum(v * v for v in ys) / total,
                "sample_share": len(ys) / len(y),
            }
        )
    pick = max(1, len(x) // 2000)
    return {"variable": variable, "unit": unit, "bins": bins, "x": x[::pick], "y": y[::pick]}


def amplitudes(values, step, floor):
    """Amplitudes of sines at some frequencies; a plain sum, for few frequencies."""
    stride = max(1, len(values) // 4000)
    values = values[::stride]
    frequency, out = [], []
    for k in range(60):
        f = 0.2 * 1.1**k
        frequency.append(f)
        w = 2 * math.pi * f * step * stride
        c = sum(v * math.cos(w * i) for i, v in enumerate(values))
        s = sum(v * math.sin(w * i) for i, v in enumerate(values))
        out.append(2 * math.hypot(c, s) / len(values) + floor)
    return frequency, out


def capture(name, tracks, step, bucket):
    s = lambda key: series(tracks[key], step, bucket) if key in tracks else None
    keys = (
        "recorded_torque",
        "torque",
        "model_torque",
        "residual",
        "refined_torque",
        "refined_residual",
        "position",
        "loop_position",
    )
    rows = len(tracks["torque"])
    return {
        "file": name,
        "sha256": "6cf6814ae14618795da0101aae2bb97ff0c6351b0501b5492751b02b07facf7e",
        "rows": rows,
        "duration_s": rows * step,
        "sample_time_s": step,
        "columns": ["time_s", "force_ref_N", "position_m"],
        "band_Hz": 59.0,
        "series": {key: s(key) for key in keys},
        "worst": [
            {
                "from_s": 0.08 * rows * step,
                "to_s": 0.12 * rows * step,
                "residual_share": 0.21,
                "sample_share": 0.04,
                "what": "cruise at 0.12 m/s, forward",
            },
            {
                "from_s": 0.5 * rows * step,
                "to_s": 0.51 * rows * step,
                "residual_share": 0.06,
                "sample_share": 0.01,
                "what": "reversal",
            },
        ],
    }


def tracks_of(position, velocity, acceleration, torque, model, refined):
    gauss = random.Random(1).gauss
    residual = [t - m for t, m in zip(torque, model)]
    return {
        "recorded_torque": [t + gauss(0, 4) for t in torque],
        "torque": torque,
        "model_torque": model,
        "residual": residual,
        "refined_torque": refined,
        "refined_residual": [t - r for t, r in zip(torque, refined)],
        "position": list(position),
        "loop_position": [p + 2e-5 for p in position],
    }
