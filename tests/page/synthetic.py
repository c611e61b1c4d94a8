"""A story (servoid.story/1) of a made-up linear axis, for the tests of the page.

The numbers are plausible, not right: the page draws what it is told.
"""

import array
import base64
import math
import random


def series(values, step, bucket=1, start=0.0):
    """Values (None: no value) as int16 between their least and most, `bucket` of them in one."""
    low, high = values, None
    if bucket > 1:
        groups = [values[i:i + bucket] for i in range(0, len(values), bucket)]
        low = [min(present(g), default=None) for g in groups]
        high = [max(present(g), default=None) for g in groups]
    known = present(low) + present(high or [])
    least, most = min(known), max(known)
    offset, scale = (least + most) / 2, (most - least) / 65534 or 1.0
    code = lambda track: base64.b64encode(array.array("h", (
        -32768 if v is None else round((v - offset) / scale) for v in track)).tobytes()).decode()
    return {"start_s": start, "step_s": step * bucket, "count": len(low), "bucket": bucket,
            "offset": offset, "scale": scale, "low": code(low), "high": code(high) if high else None}


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
        bins.append({"from": least + k * width, "to": least + (k + 1) * width, "mean": mean,
                     "std": std, "residual_share": sum(v * v for v in ys) / total,
                     "sample_share": len(ys) / len(y)})
    pick = max(1, len(x) // 2000)
    return {"variable": variable, "unit": unit, "bins": bins, "x": x[::pick], "y": y[::pick]}


def amplitudes(values, step, floor):
    """Amplitudes of sines at some frequencies; a plain sum, for few frequencies."""
    stride = max(1, len(values) // 4000)
    values = values[::stride]
    frequency, out = [], []
    for k in range(60):
        f = 0.2 * 1.1 ** k
        frequency.append(f)
        w = 2 * math.pi * f * step * stride
        c = sum(v * math.cos(w * i) for i, v in enumerate(values))
        s = sum(v * math.sin(w * i) for i, v in enumerate(values))
        out.append(2 * math.hypot(c, s) / len(values) + floor)
    return frequency, out


def parameter_table(names, values, stds, units, believed):
    n = len(names)
    return {"name": names, "unit": units, "value": values, "std": stds, "believed": believed,
            "fixed": [i == 0 and n > 3 for i in range(n)],
            "at_bound": [i == n - 1 and n > 3 for i in range(n)],
            "lower": [None] + [0.0] * (n - 1), "upper": [None] * n,
            "correlation": [[1.0 if i == j else round(math.sin(3 * (i + 1) * (j + 1)) * 0.8, 3)
                             for j in range(n)] for i in range(n)]}


def candidate(effect, probability, after, parameters, note=None):
    out = {"effect": effect, "probability": probability, "error_after": after,
           "validation_error_after": after * 1.02 if after else after, "parameters": parameters,
           "signature": "residual of " + effect}
    return out | ({"note": note} if note else {})


def comparison():
    rows = [("regime", "cruise 0.085…0.128 m/s", 0.49, 0.33), ("regime", "cruise 0…0.085 m/s", 0.34, 0.43),
            ("regime", "braking", 0.10, 0.11), ("regime", "acceleration", 0.056, 0.10),
            ("regime", "reversal", 0.005, 0.03), ("direction", "forward", 0.41, 0.5),
            ("direction", "reverse", 0.59, 0.5), ("frequency", "frequency 0…2.95 Hz", 0.985, 0.05),
            ("frequency", "frequency 2.95…59 Hz", 0.015, 0.95),
            ("position order", "order 41.4 per m (period 24.16 mm)", 0.0017, 0.0003),
            ("time", "time 0…12 s", 0.48, 0.5), ("time", "time 12…24 s", 0.52, 0.5),
            ("velocity", "velocity -0.128…0 m/s", 0.58, 0.5), ("velocity", "velocity 0…0.128 m/s", 0.42, 0.5)]
    return {"schema": "servoid.compare/1", "torque_error": 0.698, "noise_floor": 0.0057,
            "noise_floor_from": "repetition", "repeatable_share": 0.9999,
            "loop": {"torque_error": 0.6975, "position_error": 0.000185},
            "where": [{"group": g, "regime": r, "residual_share": a, "sample_share": b}
                      for g, r, a, b in rows],
            "lines": {"base_Hz": 0.16, "excited": 0.69, "odd": 4.7e-5, "even": 0.031, "between": 0.0029,
                      "mean": 0.0577, "torque": {"excited": 0.998, "odd": 4.7e-5, "even": 0.032},
                      "noise": {"excited": 0.0021, "odd": 2.5e-5, "even": 0.002},
                      "count": {"excited": 230, "odd": 37, "even": 266}},
            "lag_s": {"value": -1.8e-4, "std": 6e-5, "unit": "s"}, "band_Hz": 59.0, "band_from": "torque",
            "torque": "torque_ref", "samples": 24000, "samples_used_share": 1.0, "duration_s": 24.0,
            "warnings": ["the capture has 3 gaps"]}


def diagnosis():
    number = lambda value, std, unit: {"value": value, "std": std, "unit": unit}
    return {"schema": "servoid.diagnose/1", "verdict": "missing", "error_before": 0.694,
            "validation_error_before": 0.723, "noise_floor": 0.0056, "noise_floor_from": "repetition",
            "band_Hz": 59.0, "candidates": [
                candidate("coulomb", 0.92, 0.154, {"torque": number(36.6, 0.77, "N")}),
                candidate("viscous", 0.08, 0.167, {"coefficient": number(411.8, 8.2, "N·s/m")}),
                candidate("coulomb_asymmetric", 0.0, 0.154, {
                    "torque_forward": number(0.0, 0.0, "N"), "torque_reverse": number(73.2, 1.5, "N")},
                    "torque_forward is on its bound"),
                candidate("torque_gain", 0.0, None, {},
                          "the same as other inertia and friction: fix one of them to see it")],
            "probes": [{"variable": "velocity", "explained": 0.977}],
            "model_parameters": {"inertia": number(94.9, 3.0, "kg")},
            "next_experiment": {"experiment": "trapezoid:stroke=0.2,velocity=0.12,acceleration=1.2,cycles=2",
                                "separation": 5.1, "reason": "coulomb and viscous then differ by 5.1 times the noise"},
            "outside": None, "cannot_show": [
                {"effect": "elastic_load", "why": "nothing above 59 Hz is compared: no antiresonance there shows",
                 "record": "a multisine or a sweep to higher frequencies"}],
            "warnings": [], "advice": "add coulomb: the torque error falls from 72.3 % to 15.7 % on data it was not fitted to"}


def refinement():
    rungs = [(None, 0.694, 0.723), ("coulomb", 0.154, 0.157), ("viscous", 0.0406, 0.042),
             ("viscous_asymmetric", 0.0308, 0.0312), ("presliding", 0.0282, 0.0287)]
    return {"schema": "servoid.refine/1", "verdict": "unknown",
            "ladder": [{"added": a, "torque_error": e, "validation_error": v} for a, e, v in rungs],
            "removed": ["viscous"], "model": {}, "model_parameters": {}, "noise_floor": 0.0057,
            "band_Hz": 59.0, "next_experiment": None, "outside": None, "cannot_show": [], "warnings": [],
            "advice": "nothing in the catalogue explains the residual; a function of velocity explains 47 % of what is left"}


def response():
    f = [1.3 ** k for k in range(5, 17)]
    gain = [1 / 95 * (1 + 0.02 * math.sin(k)) for k in range(len(f))]
    return {"frequency_Hz": f, "measured_gain": gain, "measured_phase_deg": [-2.0 * k for k in range(len(f))],
            "model_gain": [1 / 95] * len(f), "model_phase_deg": [-1.5 * k for k in range(len(f))],
            "bias_percent": [2 * math.sin(k) for k in range(len(f))],
            "bias_std_percent": [0.5 + 0.1 * k for k in range(len(f))], "coherence": [0.99] * len(f)}


def capture(name, tracks, step, bucket):
    s = lambda key: series(tracks[key], step, bucket) if key in tracks else None
    keys = ("recorded_torque", "recorded_position", "torque", "model_torque", "residual", "refined_torque",
            "refined_residual", "position", "velocity", "loop_position")
    rows = len(tracks["torque"])
    return {"file": name, "sha256": "6cf6814ae14618795da0101aae2bb97ff0c6351b0501b5492751b02b07facf7e",
            "rows": rows, "duration_s": rows * step, "sample_time_s": step,
            "columns": ["time_s", "force_ref_N", "position_m"], "band_Hz": 59.0,
            "series": {key: s(key) for key in keys},
            "worst": [{"from_s": 0.08 * rows * step, "to_s": 0.12 * rows * step, "residual_share": 0.21,
                       "sample_share": 0.04, "what": "cruise at 0.12 m/s, forward"},
                      {"from_s": 0.5 * rows * step, "to_s": 0.51 * rows * step, "residual_share": 0.06,
                       "sample_share": 0.01, "what": "reversal"}]}


def tracks_of(position, velocity, acceleration, torque, model, refined):
    gauss = random.Random(1).gauss
    residual = [t - m for t, m in zip(torque, model)]
    return {"recorded_torque": [t + gauss(0, 4) for t in torque], "recorded_position": list(position),
            "torque": torque, "model_torque": model, "residual": residual, "refined_torque": refined,
            "refined_residual": [t - r for t, r in zip(torque, refined)], "position": list(position),
            "velocity": list(velocity), "loop_position": [p + 2e-5 for p in position]}


def signature(effect, against, unit, x, residual, taken):
    return {"effect": effect, "against": against, "against_unit": unit, "x": x, "residual": residual,
            "effect_torque": taken}


def story(name="axis.csv", rows=24000, step=1e-3, bucket=1, spike_at=None):
    """`spike_at`: the index of a single instant at which the torque is far off."""
    position, velocity, acceleration = map(list, move(rows, step))
    noise = random.Random(2)
    sign = lambda v: math.tanh(v / 1e-3)
    torque = [95 * a + 205 * v + 20 * sign(v) - 3 + noise.gauss(0, 0.6)
              for v, a in zip(velocity, acceleration)]
    if spike_at is not None:
        torque[spike_at] += 400
    model = [95 * a - 3 for a in acceleration]
    refined = [95 * a + 200 * v + 19.5 * sign(v) - 3 for v, a in zip(velocity, acceleration)]
    tracks = tracks_of(position, velocity, acceleration, torque, model, refined)
    pick = slice(None, None, max(1, rows // 24000))
    residual = tracks["residual"][pick]
    against = [bins_of(list(x)[pick], residual, unit, variable) for variable, unit, x in (
        ("velocity", "m/s", velocity), ("position", "m", position),
        ("acceleration", "m/s²", acceleration), ("torque", "N", torque))]
    frequency, of_torque = amplitudes(torque, step, 1e-3)
    x = [b["from"] for b in against[0]["bins"]]
    mean = [b["mean"] for b in against[0]["bins"]]
    return {
        "schema": "servoid.story/1", "title": "Linear axis: mass and offset",
        "unit": {"torque": "N", "position": "m", "velocity": "m/s", "acceleration": "m/s²"},
        "verdict": "unknown", "sentence": "Coulomb and viscous friction are missing; then a repeatable rest is left "
        "that nothing in the catalogue explains.", "advice": refinement()["advice"], "basis": "fitted",
        "given_error": 0.71, "compare": comparison(), "diagnose": diagnosis(), "refine": refinement(),
        "model_toml": 'name = "axis"\n\n[plant]\ninertia = 95.0\n',
        "refined_toml": 'name = "axis"\n\n[plant]\ninertia = 95.3\n\n[effects.coulomb]\ntorque = 13.7\n',
        "captures": [capture(name, tracks, step, bucket)], "against": against,
        "spectrum": {"frequency_Hz": frequency, "torque": of_torque,
                     "residual": amplitudes(residual, step, 5e-4)[1], "floor": [0.004] * len(frequency)},
        "orders": {"unit": "per m", "order": list(range(1, 60)),
                   "residual": [0.2 + 2.0 * (k == 40) + 0.1 * math.sin(k) for k in range(1, 60)]},
        "response": response(),
        "candidates": [signature("coulomb", "velocity", "m/s", x, mean, [36 * sign(v) for v in x]),
                       signature("viscous", "velocity", "m/s", x, mean, [400 * v for v in x])],
        "parameters": {
            "before": parameter_table(["inertia", "constant_torque.torque"], [94.9, -3.05], [3.0, 7.7],
                                      ["kg", "N"], [100.0, 0.0]),
            "after": parameter_table(
                ["inertia", "constant_torque.torque", "coulomb.torque", "viscous.coefficient"],
                [95.29, -0.098, 13.67, 205.9], [0.22, 0.14, 0.54, 1.8], ["kg", "N", "N", "N·s/m"],
                [100.0, 0.0, None, None])},
        "provenance": {"program": "servoid", "version": "0.9.0", "date": "2026-01-31T12:00:00Z",
                       "commands": ["servoid refine axis.toml axis.csv --out refined.toml"],
                       "files": [{"file": name, "bytes": 1234567, "sha256": "6cf6814ae14618795da0101aae2bb97f"
                                  "f0c6351b0501b5492751b02b07facf7e"}]}}
