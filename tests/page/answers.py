"""What compare, diagnose and refine would say of the made-up axis."""


def candidate(effect, probability, after, parameters, note=None):
    out = {
        "effect": effect,
        "probability": probability,
        "error_after": after,
        "validation_error_after": after * 1.02 if after else after,
        "parameters": parameters,
        "signature": "residual of " + effect,
    }
    return out | ({"note": note} if note else {})


def comparison():
    rows = [
        ("regime", "cruise 0.085…0.128 m/s", 0.49, 0.33),
        ("regime", "cruise 0…0.085 m/s", 0.34, 0.43),
        ("regime", "braking", 0.10, 0.11),
        ("regime", "acceleration", 0.056, 0.10),
        ("regime", "reversal", 0.005, 0.03),
        ("direction", "forward", 0.41, 0.5),
        ("direction", "reverse", 0.59, 0.5),
        ("frequency", "frequency 0…2.95 Hz", 0.985, 0.05),
        ("frequency", "frequency 2.95…59 Hz", 0.015, 0.95),
        ("position order", "order 41.4 per m (period 24.16 mm)", 0.0017, 0.0003),
        ("time", "time 0…12 s", 0.48, 0.5),
        ("time", "time 12…24 s", 0.52, 0.5),
        ("velocity", "velocity -0.128…0 m/s", 0.58, 0.5),
        ("velocity", "velocity 0…0.128 m/s", 0.42, 0.5),
    ]
    return {
        "schema": "servoid.compare/1",
        "torque_error": 0.698,
        "noise_floor": 0.0057,
        "noise_floor_from": "repetition",
        "repeatable_share": 0.9999,
        "loop": {"torque_error": 0.6975, "position_error": 0.000185},
        "where": [
            {"group": g, "regime": r, "residual_share": a, "sample_share": b} for g, r, a, b in rows
        ],
        "lines": {
            "base_Hz": 0.16,
            "excited": 0.69,
            "odd": 4.7e-5,
            "even": 0.031,
            "between": 0.0029,
            "mean": 0.0577,
            "torque": {"excited": 0.998, "odd": 4.7e-5, "even": 0.032},
            "noise": {"excited": 0.0021, "odd": 2.5e-5, "even": 0.002},
            "count": {"excited": 230, "odd": 37, "even": 266},
        },
        "lag_s": {"value": -1.8e-4, "std": 6e-5, "unit": "s"},
        "band_Hz": 59.0,
        "band_from": "torque",
        "torque": "torque_ref",
        "samples": 24000,
        "samples_used_share": 1.0,
        "duration_s": 24.0,
        "warnings": ["the capture has 3 gaps"],
    }


def diagnosis():
    number = lambda value, std, unit: {"value": value, "std": std, "unit": unit}
    return {
        "schema": "servoid.diagnose/1",
        "verdict": "missing",
        "error_before": 0.694,
        "validation_error_before": 0.723,
        "noise_floor": 0.0056,
        "noise_floor_from": "repetition",
        "band_Hz": 59.0,
        "candidates": [
            candidate("coulomb", 0.92, 0.154, {"torque": number(36.6, 0.77, "N")}),
            candidate("viscous", 0.08, 0.167, {"coefficient": number(411.8, 8.2, "N·s/m")}),
            candidate(
                "coulomb_asymmetric",
                0.0,
                0.154,
                {"torque_forward": number(0.0, 0.0, "N"), "torque_reverse": number(73.2, 1.5, "N")},
                "torque_forward is on its bound",
            ),
            candidate(
                "torque_gain",
                0.0,
                None,
                {},
                "the same as other inertia and friction: fix one of them to see it",
            ),
        ],
        "probes": [{"variable": "velocity", "explained": 0.977}],
        "model_parameters": {"inertia": number(94.9, 3.0, "kg")},
        "next_experiment": {
            "experiment": "trapezoid:stroke=0.2,velocity=0.12,acceleration=1.2,cycles=2",
            "separation": 5.1,
            "reason": "coulomb and viscous then differ by 5.1 times the noise",
        },
        "outside": None,
        "cannot_show": [
            {
                "effect": "elastic_load",
                "why": "nothing above 59 Hz is compared: no antiresonance there shows",
                "record": "a multisine or a sweep to higher frequencies",
            }
        ],
        "warnings": [],
        "advice": "add coulomb: the torque error falls from 72.3 % to 15.7 % on data it was not fitted to",
    }


def refinement():
    rungs = [
        (None, 0.694, 0.723),
        ("coulomb", 0.154, 0.157),
        ("viscous", 0.0406, 0.042),
        ("viscous_asymmetric", 0.0308, 0.0312),
        ("presliding", 0.0282, 0.0287),
    ]
    return {
        "schema": "servoid.refine/1",
        "verdict": "unknown",
        "ladder": [{"added": a, "torque_error": e, "validation_error": v} for a, e, v in rungs],
        "removed": ["viscous"],
        "model": {},
        "model_parameters": {},
        "noise_floor": 0.0057,
        "band_Hz": 59.0,
        "next_experiment": None,
        "outside": None,
        "cannot_show": [],
        "warnings": [],
        "advice": "nothing in the catalogue explains the residual; a function of velocity explains 47 % of what is left",
    }
