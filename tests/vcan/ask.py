"""GET or POST an address: ask.py METHOD URL [BODY]."""
import sys
import urllib.request

method, url, *body = sys.argv[1:]
request = urllib.request.Request(url, method=method, data=body[0].encode() if body else None,
                                 headers={"Content-Type": "application/json"})
with urllib.request.urlopen(request, timeout=25) as answer:
    sys.stdout.write(answer.read().decode())
