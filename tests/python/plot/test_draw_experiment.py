"""bench/draw_experiment.py draws the table that condyle-bench --csv writes."""
import importlib.util
from pathlib import Path

import pytest

COLUMNS = ("scene", "scene_family", "question", "deformed", "method", "method_title", "method_family", "fixed_triangles", "query_ms", "poses",
           "vertices_inside", "false_inside", "false_outside", "touch_missed", "touch_invented", "pairs", "pairs_missed", "pairs_invented")


@pytest.fixture
def drawing(source: Path):
    spec = importlib.util.spec_from_file_location("draw_experiment", source / "bench/draw_experiment.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def row(**values):
    return {**{column: "0" for column in COLUMNS}, "deformed": "no", "scene_family": "other", **values}


def grown(method, exponent):
    return [row(scene=f"sample_{n}", scene_family="sample bones", question="inside", method=method, method_title=f"by {method}",
                method_family="trees", fixed_triangles=str(10**n), query_ms=str(0.01 * 10 ** (exponent * n))) for n in range(1, 5)]


def test_cost_names_the_exponent_with_which_it_grows(drawing):
    (series,) = drawing.cost_series(grown("a", 1.5))
    assert series.label == "by a  (1.50)" and list(series.x) == [10, 100, 1000, 10000]
    (short,) = drawing.cost_series(grown("a", 1.5)[:2])
    assert short.label == "by a"


def test_shares_are_wrong_answers_over_those_that_could_be(drawing):
    rows = [row(scene="libhip_2", question="inside", method=name, method_title=name, method_family="f", query_ms="2", vertices_inside="200",
                false_inside=wrong, false_outside="3") for name, wrong in (("a", "1"), ("b", "7"))]
    series = [(one.label, one.x, one.y) for one in drawing.accuracy_series(rows, "inside")]
    assert series == [("a", [2], [0.02]), ("b", [2], [0.05])]


def test_figures_on_which_nothing_is_seen_are_left_out(drawing, tmp_path, capsys):
    rows = [*grown("a", 1), row(scene="libhip_2", question="inside", method="a", method_title="a", method_family="f", query_ms="1",
                                vertices_inside="5"), row(scene="sample_1", deformed="yes", question="pairs", query_ms="1")]
    path = tmp_path / "experiment.csv"
    lines = [",".join(COLUMNS), *(",".join(one[column] for column in COLUMNS) for one in rows)]
    path.write_text("\n".join(lines) + "\n")
    drawing.main(path, tmp_path)
    assert [found.name for found in tmp_path.glob("*.svg")] == ["cost_inside.svg"]
    assert capsys.readouterr().out.strip().endswith("cost_inside.svg")
