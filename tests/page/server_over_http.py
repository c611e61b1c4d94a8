#!/usr/bin/env python3
"""The studio's server as others on this machine meet it. See test_server.sh."""

import http.client
import json
import pathlib
import signal
import socket
import subprocess
import tempfile
import threading
import time
import unittest
import urllib.parse

import program

MOVE = "trapezoid:stroke=6.28,velocity=50,cycles=4,torque_noise=1e-3"
MODEL = program.EXAMPLES / "system1.toml"


class Server(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.capture = cls.folder + "/move.csv"
        program.run("simulate", MODEL, "--experiment", MOVE, "--out", cls.capture)

    def setUp(self):
        self.process, url = program.start_studio(MODEL, self.capture, "--no-diagnose")
        self.addCleanup(lambda: self.process.poll() is None and program.end(self.process))
        address = urllib.parse.urlsplit(url)
        self.port, self.base = address.port, address.path

    def ask(self, method, path, body=None, **headers):
        """Status and body; path "api/..." is below the token, one with a slash is as it stands."""
        line = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)
        headers = {name.replace("_", "-"): value for name, value in headers.items()}
        try:
            line.request(method, path if path[:1] == "/" else self.base + path, body, headers)
            answer = line.getresponse()
            self.headers = dict(answer.getheaders())
            return answer.status, answer.read()
        finally:
            line.close()

    def state(self, after=-1):
        status, body = self.ask("GET", f"api/state?after={after}")
        self.assertEqual(status, 200)
        return json.loads(body)

    def refused(self, status, *request, **headers):
        """With a reason as JSON, and the session goes on as it was."""
        before = self.state()["revision"]
        got, body = self.ask(*request, **headers)
        self.assertEqual(got, status, (request[:2], body[:200]))
        if status in (400, 403, 409):
            self.assertTrue(json.loads(body)["error"])
        self.assertEqual(self.state()["revision"], before)
        return body.decode(errors="replace")

    def test_no_token_no_answer(self):
        wrong = "/" + 32 * "0" + "/"
        self.assertRegex(self.base, r"^/[0-9a-f]{32}/$")
        for path in ("/", wrong, wrong + "api/state", self.base[:-2] + "/", "/api/state"):
            self.refused(404, "GET", path)
        self.refused(404, "POST", wrong + "api/do", '{"action":"fit"}')

    def test_another_host_or_page_is_refused(self):
        host = f"127.0.0.1:{self.port}"
        for other in ("evil.example", f"evil.example:{self.port}", "127.0.0.1", "127.0.0.1:1"):
            self.refused(403, "GET", "", Host=other)
            self.refused(403, "POST", "api/do", '{"action":"fit"}', Host=other)
        for page in ("http://evil.example", "null", "https://" + host, "http://127.0.0.1:1"):
            self.refused(403, "POST", "api/do", '{"action":"fit"}', Origin=page)
            self.refused(403, "GET", "api/story", Origin=page)
            self.refused(403, "POST", "api/capture?name=a.csv", "x", Origin=page)
        ours = self.ask("POST", "api/do", '{"action":"fit"}', Origin="http://" + host)
        self.assertEqual(ours[0], 200)
        self.assertEqual(self.ask("GET", "", Host=f"localhost:{self.port}")[0], 200)

    def test_headers_keep_the_page_to_itself(self):
        self.ask("GET", "")
        self.assertEqual(self.headers["X-Frame-Options"], "DENY")
        self.assertEqual(self.headers["Cache-Control"], "no-store")
        self.assertEqual(self.headers["X-Content-Type-Options"], "nosniff")
        self.assertNotIn("Access-Control-Allow-Origin", self.headers)

    def test_what_is_no_action_is_refused(self):
        for body in ("", "{", "[]", "7", "null", '"fit"', "\xff", 100000 * "["):
            self.refused(400, "POST", "api/do", body.encode("latin-1"))
        for body in (
            "{}",
            '{"action":7}',
            '{"action":"rm"}',
            '{"action":"set","name":"inertia"}',
            '{"action":"set","name":"inertia","value":"1"}',
            '{"action":"turn","index":-1,"on":false}',
            '{"action":"turn","index":1e300,"on":false}',
            '{"action":"turn","index":0.5,"on":false}',
            '{"action":"add","effect":["coulomb"]}',
        ):
            self.refused(409, "POST", "api/do", body)

    # What the worker refuses comes as the state's error.
    def test_what_cannot_be_done_is_said(self):
        for action in (
            {"action": "set", "name": "inertia", "value": -1},
            {"action": "set", "name": "no.such", "value": 1},
            {"action": "turn", "index": 999, "on": False},
            {"action": "add", "effect": "no_such"},
            {"action": "add", "name": "a/../b", "law": "k*v"},
        ):
            self.assertEqual(self.ask("POST", "api/do", json.dumps(action))[0], 200)
            self.until(lambda: self.state()["error"], f"an error of {action}")
            self.assertEqual(len(self.state()["history"]), 1)

    def until(self, condition, what, seconds=20):
        end = time.monotonic() + seconds
        while not condition():
            self.assertLess(time.monotonic(), end, "waited in vain: " + what)
            time.sleep(0.05)

    def test_a_capture_is_bytes_with_a_name_and_no_path(self):
        before = set(pathlib.Path(tempfile.gettempdir()).iterdir())
        text = pathlib.Path(self.capture).read_text()
        name = urllib.parse.quote("../../../tmp/../owned.csv", safe="")
        self.assertEqual(self.ask("POST", "api/capture?name=" + name, text)[0], 200)
        self.until(lambda: len(self.state()["captures"]) == 2, "the capture")
        self.assertEqual(self.state()["captures"][1]["file"], "owned.csv")
        for name, body in (("", text), ("a/", text), ("bad.csv", "time_s\n1\n"), ("x.csv", "")):
            quoted = urllib.parse.quote(name, safe="")
            said = self.refused(409, "POST", "api/capture?name=" + quoted, body)
            self.assertNotIn(tempfile.gettempdir(), said)
        odd = urllib.parse.quote(500 * "é" + ".csv")
        self.refused(409, "POST", "api/capture?name=" + odd, b"\0\xff" * 1000)
        left = set(pathlib.Path(tempfile.gettempdir()).iterdir()) - before
        self.assertEqual([f for f in left if "servoid" in f.name], [])

    def test_no_file_is_read_for_a_path(self):
        for path in ("../../etc/passwd", "..%2f..%2fetc%2fpasswd", "api/..", "%00", "api//state"):
            self.refused(404, "GET", path)

    def test_other_methods(self):
        self.assertEqual(self.ask("HEAD", ""), (200, b""))
        self.assertEqual(self.ask("HEAD", "", Host="evil.example")[0], 403)
        for method in ("OPTIONS", "PUT", "DELETE", "TRACE", "PATCH"):
            status, _ = self.ask(method, "api/do", "{}")
            self.assertIn(status, (400, 404, 405, 501), method)
            self.assertNotIn("Access-Control-Allow-Origin", self.headers)
        self.assertEqual(self.ask("GET", "api/do")[0], 404)

    def test_a_body_beyond_reason_is_not_read(self):
        with socket.create_connection(("127.0.0.1", self.port), 20) as line:
            line.sendall(
                f"POST {self.base}api/capture?name=a.csv HTTP/1.1\r\nHost: 127.0.0.1:{self.port}\r\n"
                "Content-Length: 99999999999\r\n\r\n".encode()
            )
            line.settimeout(20)
            self.assertRegex(line.recv(100), rb"^HTTP/1.1 413 ")
        self.state()

    def settled(self):
        """The revision once nothing is done any more: the end of the work is one more."""
        for _ in range(100):
            state = self.state()
            time.sleep(0.1)
            if state["busy"] is None and self.state()["revision"] == state["revision"]:
                return state["revision"]
        self.fail("never settled")

    def waiting(self, count):
        """So many long polls, each in a thread; their answers come into the list."""
        after, answers = self.settled(), []

        def poll():
            try:
                answers.append(self.state(after)["revision"])
            except OSError as fault:
                answers.append(fault)

        threads = [threading.Thread(target=poll, daemon=True) for _ in range(count)]
        for thread in threads:
            thread.start()
        time.sleep(0.5)
        return threads, answers

    def test_many_tabs(self):
        for count in (30, 60):
            with self.subTest(tabs=count):
                self.beside_tabs(count)

    def beside_tabs(self, count):
        threads, answers = self.waiting(count)
        self.assertEqual(answers, [], "they wait")
        start = time.monotonic()
        self.assertEqual(self.ask("POST", "api/do", '{"action":"fit"}')[0], 200)
        asked = time.monotonic() - start
        for thread in threads:
            thread.join(10)
        self.assertEqual(len(answers), count)
        print(f"figure: studio, an action beside {count} waiting tabs = {asked:.2f} s")
        self.assertLess(asked, 2)

    def test_ends_at_once_although_tabs_wait(self):
        for sign in (signal.SIGINT, signal.SIGTERM):
            self.waiting(10)
            start = time.monotonic()
            self.assertEqual(program.end(self.process, sign), 0)
            took = time.monotonic() - start
            print(f"figure: studio, {sign.name} beside 10 waiting tabs ends it in {took:.2f} s")
            self.assertLess(took, 2)
            self.setUp()

    def test_ends_before_it_has_begun(self):
        for _ in range(5):
            self.assertEqual(program.end(self.process), 0)
            self.setUp()

    def test_ends_at_once_although_it_works(self):
        self.ask("POST", "api/do", '{"action":"refine"}')
        self.until(lambda: self.state()["busy"], "work")
        start = time.monotonic()
        self.assertEqual(program.end(self.process, signal.SIGTERM), 0)
        self.assertLess(time.monotonic() - start, 3)

    def test_a_port_that_is_taken(self):
        said = program.run("studio", MODEL, self.capture, "--port", self.port, code=2, timeout=20)
        self.assertIn(f"port {self.port} cannot be listened on", said.stderr)
        self.assertEqual(said.stdout, "")

    def test_listens_on_loopback_only(self):
        table = subprocess.run(["ss", "-ltnH"], capture_output=True, text=True, check=True).stdout
        mine = [words[3] for words in map(str.split, table.splitlines()) if words[3].endswith(f":{self.port}")]
        self.assertEqual(mine, [f"127.0.0.1:{self.port}"])


if __name__ == "__main__":
    unittest.main(verbosity=1)
