"""What HDF5 calls a lack of permission: a full disk, or a file system without locks."""

import os
import shutil
import subprocess
import sys
from collections import namedtuple
from pathlib import Path

import pytest

from hopper_data import cf
from hopper_data.contents import CfDataset
from hopper_data.reading import open_stored

Usage = namedtuple("Usage", "total used free")
DATA = CfDataset({"a": (("x",), [1.0, 2.0], {})}, {}, {})
FILL = cf._fill


def write(path):
    cf.write(DATA, path, title="t", equations="e", parameters={})


@pytest.fixture
def refused(tmp_path, monkeypatch):
    """The folder in which no file can be locked."""

    def fill(dataset, attributes, path):
        if tmp_path in path.parents:
            raise PermissionError(13, "Permission denied", str(path))
        FILL(dataset, attributes, path)

    monkeypatch.setattr(cf, "_fill", fill)
    monkeypatch.setenv("TMPDIR", str(tmp_path.parent))
    return tmp_path


def test_with_room_on_the_disk_it_is_the_locks(refused, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(refused.parent))
    write(refused / "file.nc")
    assert open_stored(refused / "file.nc").a.values.tolist() == [1, 2]


def test_without_it_is_the_disk(refused, monkeypatch):
    monkeypatch.setattr(shutil, "disk_usage", lambda path: Usage(1, 1, 4096))
    with pytest.raises(OSError, match="4096 bytes free on its disk"):
        write(refused / "file.nc")
    assert list(refused.iterdir()) == []


# Refuses locks of files below a folder.
NO_LOCKS = """
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
int flock(int file, int operation) {
    char name[64], path[4096] = "";
    snprintf(name, sizeof name, "/proc/self/fd/%d", file);
    if (readlink(name, path, sizeof path - 1) < 0) return 0;
    if (strncmp(path, getenv("NO_LOCKS"), strlen(getenv("NO_LOCKS")))) return 0;
    errno = EACCES;
    return -1;
}
"""


@pytest.mark.skipif(
    sys.platform != "linux" or not shutil.which("cc"), reason="needs Linux and a compiler"
)
@pytest.mark.parametrize("settled", ["TRUE", "FALSE"])
def test_a_file_system_without_locks(tmp_path, settled):
    (tmp_path / "none.c").write_text(NO_LOCKS)
    library = tmp_path / "none.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-o", library, tmp_path / "none.c"], check=True)
    code = (
        "import sys; from hopper_data import cf, columns, contents, reading\n"
        "data = contents.CfDataset({'a': (('x',), [1.0, 2.0], {})}, {}, {})\n"
        "cf.write(data, sys.argv[1], title='t', equations='e', parameters={})\n"
        "print(reading.open_stored(sys.argv[1]).a.values.tolist())\n"
        "print(columns.columns(sys.argv[1], ['a'])[0]['a'].tolist())"
    )
    folder = tmp_path / "folder"
    environment = {"LD_PRELOAD": str(library), "NO_LOCKS": str(folder.resolve())}
    done = subprocess.run(
        [sys.executable, "-c", code, folder / "file.nc"],
        env={
            **os.environ,
            **environment,
            "PYTHONPATH": str(Path(__file__).parents[1] / "src"),
            "HDF5_USE_FILE_LOCKING": settled,
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout == 2 * "[1.0, 2.0]\n", done.stderr
