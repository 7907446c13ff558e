"""The list of materials names every library that the command loads, with version and licence: sbom_test.py SOURCE BUILD WORK."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

source, build, work = map(Path, sys.argv[1:])
command = build / "condyle"
sbom = work / "condyle.spdx.json"
subprocess.run([source / "scripts/make_sbom.py", build, sbom], check=True)
document = json.loads(sbom.read_text())


def packages_of(libraries: list[str]) -> set[str]:
    """The packages of files, each by whichever name its package installed it under."""
    names = {library: {library, os.path.realpath(library), library.removeprefix("/usr"),
                       os.path.realpath(library).removeprefix("/usr")} for library in libraries}
    answer = subprocess.run(["dpkg-query", "-S", *sorted(set().union(*names.values()))], capture_output=True, text=True, check=False)
    package_of = {path: package.split(":")[0] for package, path in
                  (line.rsplit(": ", 1) for line in answer.stdout.splitlines() if not line.startswith("diversion "))}
    for library in libraries:
        assert names[library] & set(package_of), f"{library} is of no package"
    return set(package_of.values())


def missing_from(packages: list[dict]) -> set[str]:
    loaded = subprocess.run(["ldd", command], check=True, capture_output=True, text=True).stdout
    libraries = [line.split()[2] for line in loaded.splitlines() if "=> /" in line]
    assert libraries, "the command loads no library?"
    return packages_of(libraries) - {package["name"] for package in packages}


packages = document["packages"]
assert not missing_from(packages), missing_from(packages)
assert missing_from([package for package in packages if package["name"] != "libtbb12"]) == {"libtbb12"}

assert document["spdxVersion"] == "SPDX-2.3" and document["dataLicense"] == "CC0-1.0"
identifiers = [package["SPDXID"] for package in packages]
assert len(set(identifiers)) == len(identifiers)
assert all(re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", name) for name in identifiers)
for package in packages:
    assert package["versionInfo"] and package["licenseDeclared"], package["name"]
assert "NOASSERTION" not in json.dumps(document)
# A licence that SPDX has no name for is there in words.
texts = {text["licenseId"]: text["extractedText"] for text in document["hasExtractedLicensingInfos"]}
assert set(texts) == {package["licenseDeclared"] for package in packages if package["licenseDeclared"].startswith("LicenseRef-")}
assert all(len(text) > 200 for text in texts.values())
related = {relation["relatedSpdxElement"] for relation in document["relationships"]}
assert related == set(identifiers)

# Libraries of the page have their licences in the page, and compiled-in ones are here without being listed anywhere.
licences = (source / "viewer/report_template.html").read_text()
contained = {r["relatedSpdxElement"] for r in document["relationships"] if r["relationshipType"] == "CONTAINS"}
names = {package["name"] for package in packages if package["SPDXID"] in contained}
assert "three" in names
assert all(name in licences for name in names), names
assert {"libeigen3-dev", "nlohmann-json3-dev", "libhwy-dev", "libhdf5-dev"} <= {package["name"] for package in packages}
# A static library none of whose headers is opened is known by its archive.
archives = subprocess.run(["ninja", "-C", build, "-t", "inputs", "condyle"], check=True, capture_output=True, text=True).stdout
if "libaec.a" in archives:
    assert "libaec-dev" in {package["name"] for package in packages}
print(f"{len(packages)} packages")
