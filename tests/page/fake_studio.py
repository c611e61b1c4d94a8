#!/usr/bin/env python3
"""The studio's server without a model behind it: keeps what it is told and answers as the API says.

fake_studio.py [PORT]: serves the page under /t/ and prints its address.
"""

import http.server
import json
import sys
import threading
import time
import urllib.parse

import assemble
import synthetic


def parameter(name, value, unit, std=None):
    return {
        "name": name,
        "key": name.split(".")[-1],
        "value": value,
        "std": std,
        "unit": unit,
        "fixed": False,
        "lower": 0.0,
        "upper": None,
        "meaning": "the model's " + name,
    }


class Session:
    """One state; whoever waits for a newer one is woken by every change."""

    def __init__(self):
        self.changed = threading.Condition()
        self.asked = []
        self.story = synthetic.story(rows=4000, step=5e-3)
        self.state = {
            "schema": "servoid.studio/1",
            "revision": 1,
            "story_revision": 1,
            "busy": None,
            "error": None,
            "undo": None,
            "redo": None,
            "history": [{"what": "opened", "torque_error": 0.69}],
            "model": {
                "inertia": parameter("inertia", 95.2, "kg", 0.2),
                "terms": [
                    {
                        "index": 0,
                        "effect": "constant_torque",
                        "law": "w",
                        "on": True,
                        "parameters": [parameter("constant_torque.torque", -3.05, "N", 7.7)],
                    }
                ],
            },
            "captures": [{"file": "axis.csv", "rows": 4000, "duration_s": 20.0, "on": True}],
            "effects": [
                {
                    "name": "coulomb",
                    "law": "Tc·sgn v",
                    "signature": "changes sign with velocity",
                    "cannot_add": "",
                },
                {
                    "name": "viscous",
                    "law": "D·v",
                    "signature": "proportional to velocity",
                    "cannot_add": "",
                },
                {
                    "name": "stribeck",
                    "law": "ΔT·exp(−(v/vs)²)·sgn v",
                    "signature": "largest just above standstill",
                    "cannot_add": "the model has no Coulomb friction",
                },
            ],
            "experiment": {
                "experiment": "trapezoid:stroke=0.2,cycles=2",
                "reason": "tells coulomb and viscous apart",
            },
            "can": {
                "interface": "vcan0",
                "running": False,
                "rows": 0,
                "seconds": 0.0,
                "live": {"time_s": [], "torque": [], "position": []},
            },
        }

    def change(self, **what):
        with self.changed:
            self.state.update(what)
            self.state["revision"] += 1
            self.changed.notify_all()

    def after(self, revision):
        with self.changed:
            self.changed.wait_for(lambda: self.state["revision"] > revision, timeout=20)
            return json.dumps(self.state)

    def act(self, asked):
        """What the action was refused for, or None."""
        self.asked.append(asked)
        do = getattr(self, "do_" + asked["action"], None)
        return do(asked) if do else self.change(error=None)

    def take_step(self, what, error):
        history = self.state["history"] + [{"what": what, "torque_error": error}]
        self.change(
            history=history, undo=what, error=None, story_revision=self.state["story_revision"] + 1
        )

    def do_add(self, asked):
        effect = asked.get("effect") or "custom." + asked["name"]
        if "stribeck" in effect:
            return "stribeck: the model has no Coulomb friction"
        terms = self.state["model"]["terms"]
        terms.append(
            {
                "index": len(terms),
                "effect": effect,
                "law": asked.get("law", "law of " + effect),
                "on": True,
                "parameters": [parameter(effect + ".torque", 20.0, "N", 0.6)],
            }
        )
        self.take_step("+ " + effect, 0.15)

    def do_remove(self, asked):
        del self.state["model"]["terms"][asked["index"]]
        self.take_step("removed", 0.69)

    def do_turn(self, asked):
        self.state["model"]["terms"][asked["index"]]["on"] = asked["on"]
        self.change()

    def do_set(self, asked):
        model = self.state["model"]
        for p in [model["inertia"]] + [p for t in model["terms"] for p in t["parameters"]]:
            if p["name"] == asked["name"]:
                p["value"], p["std"] = asked["value"], None
        self.change(undo="set " + asked["name"])

    def do_undo(self, _):
        self.change(redo=self.state["undo"], undo=None)

    def do_diagnose(self, _):
        self.change(
            busy={
                "what": "diagnose",
                "detail": "backlash",
                "share": 0.4,
                "elapsed_s": 3.2,
                "left_s": 5.0,
            }
        )

    def do_stop(self, _):
        self.change(busy=None)

    def do_run(self, _):
        times = [0.01 * k for k in range(200)]
        self.state["can"].update(
            running=True,
            rows=200,
            seconds=2.0,
            live={
                "time_s": times,
                "torque": [k % 50 for k in range(200)],
                "position": [0.01 * k for k in range(200)],
            },
        )
        self.change()

    def add_capture(self, name, size):
        self.change(
            captures=self.state["captures"]
            + [{"file": name, "rows": size, "duration_s": 1.0, "on": True}]
        )


class Handler(http.server.BaseHTTPRequestHandler):
    def log_message(self, *_):
        pass

    def answer(self, text, kind="application/json", status=200):
        body = text.encode()
        self.send_response(status)
        self.send_header("Content-Type", kind + "; charset=utf-8")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def do_GET(self):
        session, url = self.server.session, urllib.parse.urlparse(self.path)
        if url.path == "/t/":
            self.answer(assemble.assemble({"mode": "studio"}), "text/html")
        elif url.path == "/t/api/state":
            self.answer(session.after(int(urllib.parse.parse_qs(url.query)["after"][0])))
        elif url.path == "/t/api/story":
            self.answer(json.dumps(session.story))
        else:
            self.answer('{"error":"not here"}', status=404)

    def do_POST(self):
        session, url = self.server.session, urllib.parse.urlparse(self.path)
        body = self.rfile.read(int(self.headers["Content-Length"]))
        if url.path == "/t/api/capture":
            session.add_capture(urllib.parse.parse_qs(url.query)["name"][0], len(body))
            return self.answer("{}")
        refused = session.act(json.loads(body))
        return (
            self.answer(json.dumps({"error": refused}), status=409)
            if refused
            else self.answer("{}")
        )


class Server(http.server.ThreadingHTTPServer):
    daemon_threads = True

    def handle_error(self, *_):
        pass  # a page that was closed while it waited


def serve(port=0, session=None):
    server = Server(("127.0.0.1", port), Handler)
    server.session = session or Session()
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server


if __name__ == "__main__":
    print(f"http://127.0.0.1:{serve(int((sys.argv + [0])[1])).server_port}/t/", flush=True)
    while True:
        time.sleep(60)
