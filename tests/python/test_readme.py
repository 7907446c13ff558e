"""The Python of the README runs."""

import re


def test_the_program_of_the_readme_runs(source, capsys):
    code, = re.findall(r"```python\n(.*?)```", (source / "README.md").read_text(), re.DOTALL)
    exec(compile(code, "README.md", "exec"), {})
    depth, limit = map(float, capsys.readouterr().out.split())
    # The answer of `condyle depth` for this pose; the longest ray is 25.98 mm.
    assert f"{depth:.2f}" == "10.98" and 100 < limit < 149
