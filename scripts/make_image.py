#!/usr/bin/python3
"""Packs the static command as a container image: make_image.py BUILD OUT. Prints its path, OUT/condyle-VERSION.oci.tar.

One layer on nothing: /bin/condyle, the licences of all that is linked in, and the empty folder /data, where it works. The format is
OCI's image layout (https://github.com/opencontainers/image-spec, 1.0): JSON and gzipped tar files named after their SHA-256, in a
tar file. The same sources and command give the same bytes. docs/decisions/0032-static-command.md
"""

import gzip
import hashlib
import io
import json
import re
import subprocess
import sys
import tarfile
from datetime import datetime, timezone
from pathlib import Path

from make_sbom import SOURCE, archives_of, debian_packages, headers_of, output_of, version


def licences(build: Path) -> dict[str, bytes]:
    """Ours, those of each Debian package that was linked or had headers compiled in (with them the C and the C++ runtime, which a
    static file contains), and the common ones that these name."""
    files = {name: (SOURCE / name).read_bytes() for name in ("LICENSE", "NOTICE")}
    paths = archives_of(build, [build / "condyle"]) + headers_of(build, ("src/", "cli/"))
    packages = {name.split(":")[0] for name in debian_packages(paths).values()}
    for package in sorted(packages):
        text = Path(f"/usr/share/doc/{package}/copyright")
        if text.exists() and text.read_bytes() not in files.values():
            files[f"{package}.copyright"] = text.read_bytes()
    named = set(re.findall(rb"/usr/share/common-licenses/([A-Za-z]+-[0-9.]*[0-9])", b"".join(files.values())))
    for name in sorted(named):
        text = Path("/usr/share/common-licenses") / name.decode()
        if text.exists():
            files[f"common-licenses/{name.decode()}"] = text.read_bytes()
    return files


def tar_of(entries: list[tuple[str, bytes | None, int]]) -> bytes:
    """Files, and folders where there are no bytes, each with its permissions; of root, without a time."""
    packed = io.BytesIO()
    with tarfile.open(fileobj=packed, mode="w", format=tarfile.USTAR_FORMAT) as archive:
        for name, content, mode in entries:
            entry = tarfile.TarInfo(name)
            entry.mode = mode
            if content is None:
                entry.type = tarfile.DIRTYPE
            else:
                entry.size = len(content)
            archive.addfile(entry, None if content is None else io.BytesIO(content))
    return packed.getvalue()


def layer_of(build: Path) -> bytes:
    entries: list[tuple[str, bytes | None, int]] = [("bin/", None, 0o755), ("bin/condyle", (build / "condyle").read_bytes(), 0o755)]
    # Whoever the command runs as may write into it, when nothing is mounted there.
    entries.append(("data/", None, 0o1777))
    folder = "usr/share/doc/condyle/"
    parents = ["usr/", "usr/share/", "usr/share/doc/", folder, folder + "common-licenses/"]
    entries += [(parent, None, 0o755) for parent in parents]
    entries += [(folder + name, text, 0o644) for name, text in licences(build).items()]
    return tar_of(entries)


def annotations() -> dict[str, str]:
    """The keys that OCI defines beforehand, for the image and as its labels."""
    seconds = int(output_of("git", "-C", str(SOURCE), "log", "-1", "--format=%ct"))
    described = {
        "title": "Condyle",
        "description": "Where the bones of a joint run into each other. Research software, not a medical device.",
        "version": version(),
        "revision": output_of("git", "-C", str(SOURCE), "rev-parse", "HEAD").strip(),
        "created": datetime.fromtimestamp(seconds, timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
        "licenses": "Apache-2.0",
    }
    return {f"org.opencontainers.image.{key}": value for key, value in described.items()}


def main(build: Path, out: Path) -> None:
    layer, notes = layer_of(build), annotations()
    created = notes["org.opencontainers.image.created"]
    blobs: dict[str, bytes] = {}

    def described(kind: str, content: bytes) -> dict[str, object]:
        digest = hashlib.sha256(content).hexdigest()
        blobs[digest] = content
        return {"mediaType": f"application/vnd.oci.image.{kind}", "digest": f"sha256:{digest}", "size": len(content)}

    def json_of(value: object) -> bytes:
        return json.dumps(value, indent=1).encode()

    config = described("config.v1+json", json_of({
        "architecture": "amd64", "os": "linux", "created": created,
        "config": {"Entrypoint": ["/bin/condyle"], "Env": ["PATH=/bin"], "WorkingDir": "/data", "Labels": notes},
        "rootfs": {"type": "layers", "diff_ids": [f"sha256:{hashlib.sha256(layer).hexdigest()}"]},
        "history": [{"created": created, "created_by": "scripts/make_image.py"}],
    }))
    packed = described("layer.v1.tar+gzip", gzip.compress(layer, 9, mtime=0))
    manifest = described("manifest.v1+json", json_of({
        "schemaVersion": 2, "mediaType": "application/vnd.oci.image.manifest.v1+json", "config": config, "layers": [packed],
        "annotations": notes,
    }))
    manifest["annotations"] = {"org.opencontainers.image.ref.name": version()}
    index = json_of({"schemaVersion": 2, "mediaType": "application/vnd.oci.image.index.v1+json", "manifests": [manifest]})
    entries: list[tuple[str, bytes | None, int]] = [("oci-layout", b'{"imageLayoutVersion": "1.0.0"}', 0o644), ("index.json", index, 0o644)]
    entries += [("blobs/", None, 0o755), ("blobs/sha256/", None, 0o755)]
    entries += [(f"blobs/sha256/{digest}", content, 0o644) for digest, content in blobs.items()]
    out.mkdir(parents=True, exist_ok=True)
    image = out / f"condyle-{version()}.oci.tar"
    image.write_bytes(tar_of(entries))
    print(image)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        main(Path(sys.argv[1]), Path(sys.argv[2]))
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"make_image.py: {error}")
