"""W11: requests and messages as no page sends them.  `benchmarks/studio_fuzz.py` sends 5,000."""

import threading
import time

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.oracles import strange_requests as strange
from tests.samples import share

house = settings(max_examples=share(150), suppress_health_check=list(HealthCheck))


@house
@given(request=strange.requests())
def test_no_request_breaks_the_server_or_gets_what_it_must_not(visitor, request):
    assert strange.fault(request, *strange.sent(visitor, request)) is None


@settings(house, max_examples=share(30))
@given(said=st.lists(strange.messages(), min_size=1, max_size=4))
def test_no_message_breaks_a_tab(visitor, said):
    assert strange.fault_of_messages(visitor, said) is None


def test_the_judge_of_answers_can_fail():
    good = ("POST", "/check", "application/json", None, None, True, b'{"document": {"poses": []}}')
    assert "taken" in strange.fault(good, 200, b"{}")
    assert "500" in strange.fault(good, 500, b"{}")
    assert "without the key" in strange.fault((*good[:5], False, b""), 200, b"{}")
    assert "another site" in strange.fault((*good[:3], "evil.com", None, True, b""), 200, b"{}")
    assert strange.fault(good, 422, b'{"messages": [{"message": "a"}]}') is None


def test_the_page_answers_under_a_flood(visitor):
    """Some 200 requests of rubbish a second, until the page has been opened twenty times."""
    rubbish = [b"\0" * 100, b"GET / HTTP/9.9\r\n\r\n", b"POST /check HTTP/1.1\r\nhost: a\r\n\r\n{}"]
    over = threading.Event()

    def flood():
        while not over.is_set():
            visitor.raw(rubbish[int(time.monotonic() * 1e4) % len(rubbish)])
            time.sleep(0.02)

    floods = [threading.Thread(target=flood) for _ in range(4)]
    for each in floods:
        each.start()
    try:
        for _ in range(20):
            assert visitor.http.get("/").status_code == 200
            assert visitor.http.get("/start").status_code == 200
        assert all(each.is_alive() for each in floods)
    finally:
        over.set()
        for each in floods:
            each.join()
