"""A story (servoid.story/1) of a made-up linear axis, for the tests of the page.

The numbers are plausible, not right: the page draws what it is told.
"""

import math
import random

import answers
import axis


def parameter_table(names, values, stds, units, believed):
    n = len(names)
    return {
        "name": names,
        "unit": units,
        "value": values,
        "std": stds,
        "believed": believed,
        "fixed": [i == 0 and n > 3 for i in range(n)],
        "at_bound": [i == n - 1 and n > 3 for i in range(n)],
        "lower": [None] + [0.0] * (n - 1),
        "upper": [None] * n,
        "correlation": [
            [1.0 if i == j else round(math.sin(3 * (i + 1) * (j + 1)) * 0.8, 3) for j in range(n)]
            for i in range(n)
        ],
    }


def response():
    f = [1.3**k for k in range(5, 17)]
    gain = [1 / 95 * (1 + 0.02 * math.sin(k)) for k in range(len(f))]
    return {
        "frequency_Hz": f,
        "measured_gain": gain,
        "measured_phase_deg": [-2.0 * k for k in range(len(f))],
        "model_gain": [1 / 95] * len(f),
        "model_phase_deg": [-1.5 * k for k in range(len(f))],
        "bias_percent": [2 * math.sin(k) for k in range(len(f))],
        "bias_std_percent": [0.5 + 0.1 * k for k in range(len(f))],
        "coherence": [0.99] * len(f),
    }


def signature(effect, against, unit, x, residual, taken):
    return {
        "effect": effect,
        "against": against,
        "against_unit": unit,
        "value": "mean torque",
        "value_unit": "N",
        "x": x,
        "residual": residual,
        "effect_torque": taken,
    }


def story(name="axis.csv", rows=24000, step=1e-3, bucket=1, spike_at=None):
    """`spike_at`: the index of a single instant at which the torque is far off."""
    position, velocity, acceleration = map(list, axis.move(rows, step))
    noise = random.Random(2)
    sign = lambda v: math.tanh(v / 1e-3)
    torque = [
        95 * a + 205 * v + 20 * sign(v) - 3 + noise.gauss(0, 0.6)
        for v, a in zip(velocity, acceleration)
    ]
    if spike_at is not None:
        torque[spike_at] += 400
    model = [95 * a - 3 for a in acceleration]
    refined = [95 * a + 200 * v + 19.5 * sign(v) - 3 for v, a in zip(velocity, acceleration)]
    tracks = axis.tracks_of(position, velocity, acceleration, torque, model, refined)
    pick = slice(None, None, max(1, rows // 24000))
    residual = tracks["residual"][pick]
    against = [
        axis.bins_of(list(x)[pick], residual, unit, variable)
        for variable, unit, x in (
            ("velocity", "m/s", velocity),
            ("position", "m", position),
            ("acceleration", "m/s²", acceleration),
            ("torque", "N", torque),
        )
    ]
    frequency, of_torque = axis.amplitudes(torque, step, 1e-3)
    x = [b["from"] for b in against[0]["bins"]]
    mean = [b["mean"] for b in against[0]["bins"]]
    return {
        "schema": "servoid.story/1",
        "title": "Linear axis: mass and offset",
        "unit": {"torque": "N", "position": "m", "velocity": "m/s", "acceleration": "m/s²"},
        "verdict": "unknown",
        "sentence": "Coulomb and viscous friction are missing; then a repeatable rest is left "
        "that nothing in the catalogue explains.",
        "advice": answers.refinement()["advice"],
        "basis": "fitted",
        "given_error": 0.71,
        "compare": answers.comparison(),
        "diagnose": answers.diagnosis(),
        "refine": answers.refinement(),
        "model_toml": 'name = "axis"\n\n[plant]\ninertia = 95.0\n',
        "refined_toml": 'name = "axis"\n\n[plant]\ninertia = 95.3\n\n[effects.coulomb]\ntorque = 13.7\n',
        "captures": [axis.capture(name, tracks, step, bucket)],
        "against": against,
        "spectrum": {
            "frequency_Hz": frequency,
            "torque": of_torque,
            "residual": axis.amplitudes(residual, step, 5e-4)[1],
            "floor": [0.004] * len(frequency),
        },
        "orders": {
            "unit": "per m",
            "order": list(range(1, 60)),
            "residual": [0.2 + 2.0 * (k == 40) + 0.1 * math.sin(k) for k in range(1, 60)],
        },
        "response": response(),
        "candidates": [
            signature("coulomb", "velocity", "m/s", x, mean, [36 * sign(v) for v in x]),
            signature("viscous", "velocity", "m/s", x, mean, [400 * v for v in x]),
        ],
        "parameters": {
            "before": parameter_table(
                ["inertia", "constant_torque.torque"],
                [94.9, -3.05],
                [3.0, 7.7],
                ["kg", "N"],
                [100.0, 0.0],
            ),
            "after": parameter_table(
                ["inertia", "constant_torque.torque", "coulomb.torque", "viscous.coefficient"],
                [95.29, -0.098, 13.67, 205.9],
                [0.22, 0.14, 0.54, 1.8],
                ["kg", "N", "N", "N·s/m"],
                [100.0, 0.0, None, None],
            ),
        },
        "provenance": {
            "program": "servoid",
            "version": "0.9.0",
            "date": "2026-01-31T12:00:00Z",
            "commands": ["servoid refine axis.toml axis.csv --out refined.toml"],
            "files": [
                {
                    "file": name,
                    "bytes": 1234567,
                    "sha256": "6cf6814ae14618795da0101aae2bb97f" "f0c6351b0501b5492751b02b07facf7e",
                }
            ],
        },
    }
