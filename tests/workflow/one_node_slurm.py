"""A Slurm of one node on this machine, from a scratch folder: no systemd, no cgroups, no accounting."""

import os
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path
from typing import Callable, Dict, List

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "sinfo")


def missing_programs() -> List[str]:
    path = os.environ["PATH"] + ":/usr/sbin:/sbin"
    return [name for name in PROGRAMS if shutil.which(name, path=path) is None]


def free_port() -> int:
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return int(listener.getsockname()[1])


def wait_for(what: str, is_so: Callable[[], bool], seconds: float = 30) -> None:
    end = time.monotonic() + seconds
    while not is_so():
        if time.monotonic() > end:
            raise TimeoutError(f"waited {seconds} s for {what}")
        time.sleep(0.1)


class OneNodeSlurm:
    """Daemons that this process has started, and ends."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.user = subprocess.run(["id", "-un"], check=True, capture_output=True, text=True).stdout.strip()
        self.daemons: Dict[str, "subprocess.Popen[bytes]"] = {}
        self.environment = {**os.environ, "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin", "SLURM_CONF": str(folder / "slurm.conf")}

    def __enter__(self) -> "OneNodeSlurm":
        # munged wants a folder that others may pass through but not write to.
        self.folder.chmod(0o711)
        for name in ("state", "spool", "munge"):
            (self.folder / name).mkdir()
        (self.folder / "munge").chmod(0o711)
        key = self.folder / "munge/key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        self.write_conf()
        munge = self.folder / "munge"
        self.start("munged", "--foreground", "--force", f"--socket={munge}/socket", f"--key-file={key}",
                   f"--log-file={munge}/log", f"--pid-file={munge}/pid", f"--seed-file={munge}/seed")
        wait_for("munged", (munge / "socket").exists)
        self.start("slurmctld", "-D", "-f", self.environment["SLURM_CONF"])
        self.start_node()
        return self

    def __exit__(self, *_: object) -> None:
        self.run("scancel", "--user", self.user, check=False)
        for name in reversed(list(self.daemons)):
            self.end(name, signal.SIGTERM)

    def write_conf(self) -> None:
        cpus = os.cpu_count() or 1
        (self.folder / "slurm.conf").write_text(f"""ClusterName=test
SlurmctldHost={socket.gethostname()}(127.0.0.1)
SlurmUser={self.user}
SlurmdUser={self.user}
SlurmctldPort={free_port()}
AuthType=auth/munge
CryptoType=crypto/munge
AuthInfo=socket={self.folder}/munge/socket,cred_expire=5
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout=10
EnforcePartLimits=ALL
SchedulerParameters=bf_interval=2,sched_interval=2
KillWait=2
NodeName=n1 NodeHostname={socket.gethostname()} NodeAddr=127.0.0.1 Port={free_port()} CPUs={cpus}
PartitionName=main Nodes=n1 Default=YES MaxTime=INFINITE State=UP
""", encoding="utf-8")

    def start(self, name: str, *arguments: str) -> None:
        self.daemons[name] = subprocess.Popen([name, *arguments], env=self.environment, stdin=subprocess.DEVNULL,
                                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def end(self, name: str, number: int) -> None:
        daemon = self.daemons.pop(name)
        daemon.send_signal(number)
        try:
            daemon.wait(10)
        except subprocess.TimeoutExpired:
            daemon.kill()
            daemon.wait()

    def start_node(self) -> None:
        self.start("slurmd", "-D", "-N", "n1", "-f", self.environment["SLURM_CONF"])
        wait_for("the node", lambda: self.run("sinfo", "--noheader", "--format=%t").strip() in ("idle", "mix", "alloc"), 60)

    def lose_node(self) -> None:
        """Ends the daemon and all that runs below it at once, as a power cut does."""
        jobs = self.pids_of_jobs()
        self.end("slurmd", signal.SIGKILL)
        for pid in jobs:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def pids_of_jobs(self) -> List[int]:
        """Processes with this Slurm's configuration in their environment that none of the daemons is: steps and jobs."""
        mark, own = f"SLURM_CONF={self.folder / 'slurm.conf'}".encode(), {d.pid for d in self.daemons.values()}
        found = []
        for entry in Path("/proc").iterdir():
            if not entry.name.isdigit() or int(entry.name) in own:
                continue
            try:
                words = (entry / "environ").read_bytes().split(b"\0")
            except OSError:
                continue
            is_of_job = any(word.startswith((b"SLURM_JOB_ID=", b"SLURM_STEPD")) for word in words)
            is_step = (entry / "cmdline").read_bytes().startswith(b"slurmstepd") if (entry / "cmdline").exists() else False
            if mark in words and (is_of_job or is_step):
                found.append(int(entry.name))
        return found

    def run(self, *command: str, check: bool = True) -> str:
        return subprocess.run(command, check=check, env=self.environment, capture_output=True, text=True).stdout

    def has_jobs(self) -> bool:
        return bool(self.run("squeue", "--noheader").strip())
