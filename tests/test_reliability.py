"""The page of the reliability tests is made of what they recorded."""

import pytest

from tests import reliability


def test_a_record_becomes_a_table(tmp_path, monkeypatch):
    monkeypatch.setattr(reliability, "RECORDS", tmp_path / "records")
    reliability.record("kill_and_resume", "All was killed.", {"moments killed": 20, "lost": 0})
    page = reliability.render(tmp_path / "records")
    assert "## Kill and resume\n\nAll was killed.\n" in page
    assert "| moments killed | 20 |\n| lost | 0 |\n" in page


def test_without_records_there_is_no_page(tmp_path):
    with pytest.raises(FileNotFoundError, match="make reliability"):
        reliability.render(tmp_path)
