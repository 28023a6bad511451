"""Ctrl-C while work is going on: exit code 130, one line that says what is known, no process left."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil
import pytest


@pytest.mark.skipif(sys.platform == "win32", reason="process groups and SIGINT are those of POSIX")
@pytest.mark.parametrize("workers", ["1", "2"])
def test_ctrl_c(workers, tmp_path):
    command = [sys.executable, "-m", "singsym", "classify", "zlatanov-hybrid-3-2", "--workers", workers]
    process = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        cwd=Path(__file__).parents[2],
        env={**os.environ, "SINGSYM_CACHE": str(tmp_path)},
        # a test run in the background of a shell ignores Ctrl-C, and so would its children
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    try:
        time.sleep(6)
        children = psutil.Process(process.pid).children(recursive=True)
        os.killpg(process.pid, signal.SIGINT)
        out, err = process.communicate(timeout=20)
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
    assert process.returncode == 130
    assert out == ""
    assert err.startswith("singsym classify: interrupted")
    assert "Traceback" not in err
    assert not psutil.wait_procs(children, timeout=5)[1]
