#!/usr/bin/env python3
"""Writes what an artefact is made of as SPDX 2.3: make_sbom.py BUILD_FOLDER SBOM [PROGRAM...].

PROGRAMs lie in BUILD_FOLDER: the command and the Python module where none is named. Three kinds, none listed by hand: libraries that
they load (ldd), packages whose headers were compiled in or whose static libraries were linked in (what ninja noted of each), and web
packages bundled into the page of a report (what its sources import, with their dependencies in package-lock.json). Debian's packages
are asked for version and licence; where SPDX has no name for a licence, the text that Debian's package has of it is enclosed.
"""

import json
import os
import re
import subprocess
import sys
import time
from datetime import datetime, timezone
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent

# Debian's short names (copyright-format 1.0) that SPDX has under another one.
SPDX_NAMES = {
    "Expat": "MIT", "BSD-2-clause": "BSD-2-Clause", "BSD-3-clause": "BSD-3-Clause", "BSL-1": "BSL-1.0", "Apache-2": "Apache-2.0",
    "GPL-2": "GPL-2.0-only", "GPL-2+": "GPL-2.0-or-later", "GPL-3+": "GPL-3.0-or-later", "LGPL-2+": "LGPL-2.0-or-later",
    "LGPL-2.1": "LGPL-2.1-only", "LGPL-2.1+": "LGPL-2.1-or-later", "LGPL-3+": "LGPL-3.0-or-later", "zlib": "Zlib",
    "MPL-2": "MPL-2.0",
}
KNOWN = set(SPDX_NAMES.values()) | {"Apache-2.0", "BSD-2-Clause", "BSD-3-Clause", "BSL-1.0", "ISC", "MIT", "MPL-2.0", "Zlib",
                                    "CC0-1.0", "curl", "OpenLDAP-2.8"}


def output_of(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def version() -> str:
    text = (SOURCE / "include/condyle/version.hpp").read_text()
    return re.search(r'version = "(.*)"', text).group(1)


def libraries_of(program: Path) -> list[str]:
    """Paths of the shared libraries that a program or module loads, those of its libraries too: none of a static one."""
    said = subprocess.run(["ldd", str(program)], capture_output=True, text=True, check=False)
    if said.returncode and not re.search("not a dynamic|not a valid", said.stdout + said.stderr):
        sys.exit(f"make_sbom.py: {program}: {said.stderr.strip()}")
    paths = set(re.findall(r"(/\S+) \(0x", said.stdout))
    # No file says so: oneTBB loads its memory pool from its own folder, where that is there.
    pools = [Path(path).with_name("libtbbmalloc.so.2") for path in paths if Path(path).name.startswith("libtbb.")]
    return sorted(paths | {str(pool) for pool in pools if pool.exists()})


def headers_of(build: Path, folders: tuple[str, ...]) -> list[str]:
    """Headers of the system that the objects below these folders were compiled with."""
    headers: set[str] = set()
    ours = False
    for line in output_of("ninja", "-C", str(build), "-t", "deps").splitlines():
        if line and not line.startswith(" "):
            ours = line.startswith(folders)
        elif ours:
            headers.add(line.strip())
    # Another system's compiler sees those of this machine through links in the build folder: cmake/HeaderPackages.cmake.
    real = {os.path.realpath(build / header) for header in headers if header}
    return sorted(header for header in real if header.startswith("/usr/"))


def archives_of(build: Path, programs: list[Path]) -> list[str]:
    """Static libraries of the system that programs or modules were linked with."""
    inputs = output_of("ninja", "-C", str(build), "-t", "inputs", *(str(program.relative_to(build)) for program in programs))
    return sorted({line for line in inputs.splitlines() if line.startswith("/usr/") and line.endswith(".a")})


def debian_packages(paths: list[str]) -> dict[str, str]:
    """The package of each path, with its architecture where it has several."""
    found: dict[str, str] = {}
    for first in range(0, len(paths), 500):
        # Debian's /lib is /usr/lib, and a file is known by the name that its package installed it under.
        asked = [name for path in paths[first:first + 500]
                 for real in {path, str(Path(path).resolve())} for name in (real, real.removeprefix("/usr"), "/usr" + real)]
        answer = subprocess.run(["dpkg-query", "-S", *asked], capture_output=True, text=True, check=False).stdout
        for line in answer.splitlines():
            if not line.startswith("diversion "):
                names, path = line.rsplit(": ", 1)
                found[path] = names.split(", ")[0]
    packages = {}
    for path in paths:
        for real in (path, str(Path(path).resolve())):
            for name in (real, real.removeprefix("/usr"), "/usr" + real):
                if name in found:
                    packages[path] = found[name]
    return packages


def debian_licence(package: str) -> tuple[str, str, str]:
    """SPDX name, Debian's own word for the package's files as a whole, and where SPDX has no name, the text."""
    name = package.split(":")[0]
    path = Path("/usr/share/doc") / name / "copyright"
    if not path.exists():
        sys.exit(f"make_sbom.py: {name} has no {path}")
    text = path.read_text(errors="replace")
    whole = re.search(r"^Files:\s*\*\s*$.*?^License:[ \t]*(\S.*?)?$", text, re.MULTILINE | re.DOTALL)
    word = (whole.group(1) or "").strip() if whole else ""
    spdx = SPDX_NAMES.get(word, word)
    comment = f"{word or 'in words'}: {path}"
    return (spdx, comment, "") if spdx in KNOWN else (f"LicenseRef-Debian-{identifier_part(name)}", comment, text)


def identifier_part(text: str) -> str:
    return re.sub(r"[^A-Za-z0-9.-]", "-", text)


def identifier(*parts: str) -> str:
    return "SPDXRef-" + identifier_part("-".join(parts))


def entry(kind: str, name: str, of_version: str, place: str, licence: str, comment: str, url: str) -> dict:
    return {"SPDXID": identifier(kind, name), "name": name, "versionInfo": of_version, "downloadLocation": place,
            "filesAnalyzed": False, "licenseDeclared": licence, "licenseComments": comment,
            "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl", "referenceLocator": url}]}


def debian_entry(package: str) -> tuple[dict, dict | None]:
    """The package, and its licence's text where SPDX has no name for it."""
    fields = "${Version} ${Architecture} ${source:Package} ${source:Version}"
    of_version, architecture, source, source_version = output_of("dpkg-query", "-W", "-f", fields, package).split()
    licence, comment, text = debian_licence(package)
    name = package.split(":")[0]
    return (entry("Debian", name, of_version, f"https://sources.debian.org/src/{source}/{source_version.split(':')[-1]}/", licence,
                  comment, f"pkg:deb/debian/{name}@{of_version}?arch={architecture}"),
            {"licenseId": licence, "name": f"as Debian's {name} states it", "extractedText": text} if text else None)


def web_packages() -> list[dict]:
    """Packages that the page's sources import, with their dependencies."""
    lock = json.loads((SOURCE / "viewer/package-lock.json").read_text())["packages"]
    named = json.loads((SOURCE / "viewer/package.json").read_text())["devDependencies"]
    asked = set()
    for source in (SOURCE / "viewer/src").rglob("*.ts"):
        for module in re.findall(r"""from ["']([^."'][^"']*)["']""", source.read_text()):
            asked.add("/".join(module.split("/")[:2 if module.startswith("@") else 1]))
    asked &= set(named)  # the rest is of the page's own
    found: dict[str, dict] = {}
    while asked:
        name = asked.pop()
        locked = lock["node_modules/" + name]
        found[name] = entry("npm", name, locked["version"], f"https://www.npmjs.com/package/{name}/v/{locked['version']}", locked["license"],
                            "package-lock.json", f"pkg:npm/{name}@{locked['version']}")
        asked |= set(locked.get("dependencies", {})) - set(found)
    return [found[name] for name in sorted(found)]


def sbom_of(build: Path, programs: list[Path], name: str) -> dict:
    linked = debian_packages([path for program in programs for path in libraries_of(program)])
    # A build has objects that one artefact holds and another does not, or none, as tests.
    folders = {f"{program.relative_to(build).parts[0]}/" if program.parent != build else "cli/" for program in programs} | {"src/"}
    compiled_in = debian_packages(headers_of(build, tuple(folders) if (build / "src").exists() else ("",)) + archives_of(build, programs))
    unknown = {path for program in programs for path in libraries_of(program)} - set(linked)
    if unknown:
        sys.exit(f"make_sbom.py: of no Debian package: {', '.join(sorted(unknown))}")
    own = version()
    condyle = {"SPDXID": "SPDXRef-condyle", "name": "condyle", "versionInfo": own, "downloadLocation": "NONE",
               "filesAnalyzed": False, "licenseConcluded": "Apache-2.0", "licenseDeclared": "Apache-2.0",
               "copyrightText": "Copyright 2026 The Condyle authors"}
    packages, relations, texts = [condyle], [("SPDXRef-DOCUMENT", "DESCRIBES", "SPDXRef-condyle")], []
    for package in sorted(set(linked.values()) | set(compiled_in.values())):
        made_of, text = debian_entry(package)
        packages.append(made_of)
        texts += [text] if text else []
        if package in linked.values():
            relations.append(("SPDXRef-condyle", "DYNAMIC_LINK", packages[-1]["SPDXID"]))
        if package in compiled_in.values():
            relations.append(("SPDXRef-condyle", "STATIC_LINK", packages[-1]["SPDXID"]))
    for package in web_packages():
        packages.append(package)
        relations.append(("SPDXRef-condyle", "CONTAINS", package["SPDXID"]))
    made = datetime.fromtimestamp(int(os.environ.get("SOURCE_DATE_EPOCH", time.time())), timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": name,
            "documentNamespace": f"urn:condyle:sbom:{name}:{made}",
            "creationInfo": {"created": made, "creators": ["Organization: The Condyle authors", "Tool: make_sbom.py"]},
            "packages": packages, "hasExtractedLicensingInfos": texts,
            "relationships": [{"spdxElementId": a, "relationshipType": kind, "relatedSpdxElement": b} for a, kind, b in relations]}


def main() -> None:
    if len(sys.argv) < 3:
        sys.exit("usage: make_sbom.py BUILD_FOLDER SBOM [PROGRAM...]")
    build, out, *programs = map(Path, sys.argv[1:])
    programs = [build / program for program in programs]
    if not programs:
        programs = [path for path in (build / "condyle", *(build / "python/condyle").glob("_native*.so")) if path.exists()]
    out.parent.mkdir(parents=True, exist_ok=True)
    beside = out.with_name(out.name + ".part")
    beside.write_text(json.dumps(sbom_of(build, programs, out.name.removesuffix(".spdx.json")), indent=1) + "\n")
    beside.rename(out)


if __name__ == "__main__":
    main()
