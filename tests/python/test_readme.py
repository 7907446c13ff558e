"""The Python of the README runs, and answers what its command line and its C++ do."""

import re


def test_the_program_of_the_readme_runs(source, capsys):
    readme = (source / "README.md").read_text()
    code, = re.findall(r"```python\n(.*?)```", readme, re.DOTALL)
    exec(compile(code, "README.md", "exec"), {})
    printed = capsys.readouterr().out
    assert printed == code.splitlines()[-1].partition("  # ")[2] + "\n"
    # One joint and one pose, so one depth.
    depth, = re.findall(r"^  depth: ([0-9.]+) mm to the nearest surface", readme, re.MULTILINE)
    in_cpp, = re.findall(r"^It prints `depth ([0-9.]+) mm to the surface, ", readme, re.MULTILINE)
    assert printed.startswith(f"{depth} mm, ") and f"{float(depth):.2f}" == in_cpp
