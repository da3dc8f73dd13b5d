"""Nobody but its user reaches the workbench, no other file is read, and nothing is run that the user did not name."""

import json
import os
import subprocess
from urllib.error import HTTPError
from urllib.parse import urlsplit
from urllib.request import Request, urlopen

import numpy as np
import pytest

from mutated_messages import Talker, mutated
from workbench_server import COMMAND, Server

websockets = pytest.importorskip("websockets.sync.client")


def status(address, **headers):
    try:
        with urlopen(Request(address, headers=headers)) as answer:
            return answer.status
    except HTTPError as error:
        return error.code


@pytest.fixture
def root(shared):
    parts = urlsplit(shared.address)
    return f"{parts.scheme}://{parts.netloc}"


def test_the_page_is_given_for_its_token_alone(shared, root):
    assert status(shared.address) == 200
    for wrong in (f"{root}/", f"{root}/x/", f"{root}/{'a' * 22}/", f"{root}/app.js"):
        assert status(wrong) == 404


def test_another_name_of_this_machine_is_refused(shared):
    assert status(shared.address, Host="evil.example:80") == 404
    assert status(shared.address, Origin="http://evil.example") == 404


@pytest.mark.parametrize("name", ["campaign.toml", "sine_hv.csv", "..%2fcampaign.toml", "%2e%2e/%2e%2e/etc/passwd",
                                  "..%5c..%5cetc", "server.py", ".slipwise", "session.json"])  # fmt: skip
def test_no_file_is_given_but_the_page_s_own(shared, name):
    assert status(f"{shared.address}{name}") == 404


def test_it_listens_on_this_machine_only(shared):
    port = urlsplit(shared.address).port
    table = open(f"/proc/{shared.process.pid}/net/tcp").read().splitlines()[1:]
    listening = [row.split()[1] for row in table if row.split()[1].endswith(f":{port:04X}") and row.split()[3] == "0A"]
    assert listening == [f"0100007F:{port:04X}"]


@pytest.mark.parametrize("origin", ["http://evil.example", "null"])
def test_a_socket_of_another_site_is_refused(shared, origin):
    address = shared.address.replace("http", "ws") + "socket"
    with pytest.raises(Exception, match="403|HTTP"):
        websockets.connect(address, origin=origin)


def test_a_socket_without_the_token_is_refused(shared, root):
    with pytest.raises(Exception, match="403|HTTP"):
        websockets.connect(f"{root.replace('http', 'ws')}/nothing/socket")


def answers(shared, *messages):
    """Send messages, and give what is said of problems until every one is answered."""
    address = shared.address.replace("http", "ws") + "socket"
    with websockets.connect(address, max_size=None) as talk:
        for message in messages:
            talk.send(message if isinstance(message, str) else json.dumps(message))
        talk.send(json.dumps({"do": "no such thing"}))
        said = []
        while not (said and "no such thing" in said[-1]):
            told = talk.recv(timeout=60)
            content = json.loads(told) if isinstance(told, str) else {}
            if content.get("kind") == "problem":
                said.append(content["words"])
        return said[:-1]


def test_a_page_names_no_file_that_is_run(shared, tmp_path):
    trap = tmp_path / "trap.py"
    trap.write_text(f"open({str(tmp_path / 'ran')!r}, 'w')")
    said = answers(shared, {"do": "toggle", "effect": str(trap)}, {"do": "law"})
    assert "may name effects, but no file" in said[0] and "no law was found" in said[1]
    assert not (tmp_path / "ran").exists()


def test_nonsense_is_answered_and_harms_nobody(shared):
    said = answers(
        shared, {"do": "drag", "key": "rig.mass", "value": "x", "n": 1}, {"do": "toggle"}, {}, {"do": "set", "key": 3}
    )
    assert len(said) == 4 and all("did not understand" in words for words in said)
    assert status(shared.address) == 200


def test_damaged_messages_are_answered_by_sentences_alone(new_folder, tmp_path):
    said = tmp_path / "terminal"
    with said.open("wb") as stream:
        server = Server.of(new_folder, stderr=stream)
        page = Talker(server.address)
        rng = np.random.default_rng(11)
        for _ in range(300):
            data, as_text = mutated(rng)
            page.say(data, as_text=as_text)
        page.say(b"\xff", as_text=False)
        page.say(b"\xff\xff", as_text=True)  # no text at all: the server hangs up
        assert page.answered() and page.hung_up
        page.close()
        server.end()
    assert "Traceback" not in said.read_text()


@pytest.mark.parametrize("name", ["report.html", "diagnosis.html"])
def test_a_report_is_given_where_it_is_a_file_of_the_session_and_no_link_out_of_it(shared, name):
    page = shared.folder / ".slipwise" / name
    page.write_text("<p>mine</p>")
    with urlopen(f"{shared.address}{name}") as answer:
        assert answer.read() == b"<p>mine</p>" and "script-src" not in answer.headers["Content-Security-Policy"]
    for put in (lambda: page.symlink_to("/etc/passwd"), lambda: os.mkfifo(page), page.mkdir):
        page.rmdir() if page.is_dir() and not page.is_symlink() else page.unlink()
        put()
        assert status(f"{shared.address}{name}") == 404
    page.rmdir()


def test_a_link_to_a_model_outside_of_the_campaign_is_not_offered(shared, tmp_path):
    (tmp_path / "outside.toml").write_text("rig = 'bridge1'")
    (shared.folder / "outside.toml").symlink_to(tmp_path / "outside.toml")
    (shared.folder / "inside.toml").write_text("rig = 'bridge1'")
    page = Talker(shared.address)
    assert page.answered() and page.models == ["inside.toml"]
    page.close()


def test_the_address_that_a_browser_is_started_with_works_once(new_folder, tmp_path):
    server = Server.early(new_folder, tmp_path)
    with urlopen(server.address) as answer:
        token = answer.geturl()
    assert "/once/" in server.address and "/once/" not in token and status(token) == 200
    with pytest.raises(HTTPError) as refused:
        urlopen(server.address)
    assert "another user of this machine may have" in refused.value.read().decode()
    assert status(server.address.replace("once", "x"), Host="evil.example:80") == 404
    server.end()


def test_a_second_workbench_of_a_campaign_says_where_the_first_is(shared):
    done = subprocess.run([*COMMAND, str(shared.folder), "--no-show"], capture_output=True, text=True)
    assert done.returncode == 2 and shared.address in done.stderr
