"""The scripts of the three Slurm jobs of a batch: prepare.sh, frames.sh (the job array) and merge.sh."""
import dataclasses
import pathlib
import shlex

PREPARE, FRAMES, MERGE = "prepare.sh", "frames.sh", "merge.sh"


@dataclasses.dataclass(frozen=True)
class Batch:
    malus: str
    folder: pathlib.Path  # the merged frames; its folder `cluster` has everything else
    model: str | None  # model file or scene.json to bake; the pack is already in cluster/ if None
    jobs: str  # name of the copy of the jobs in cluster/
    tasks: int
    bake: list[str]  # options of `malus bake`
    options: list[str]  # options of `malus batch`
    slurm: list[str]  # options of sbatch for all jobs
    slurm_frames: list[str]  # options of sbatch for the job array

    @property
    def cluster(self) -> pathlib.Path:
        return self.folder / "cluster"

    def shard(self, number: int) -> pathlib.Path:
        return self.cluster / "shards" / f"{number}-of-{self.tasks}"


def quote(*words) -> str:
    return " ".join(shlex.quote(str(word)) for word in words)


def header(batch: Batch, title: str, name: str, log: str, more: list[str]) -> str:
    """Later lines of #SBATCH override earlier ones, so the options of the user come last."""
    lines = [f"--job-name={name}", "--nodes=1", "--ntasks=1", "--requeue", "--open-mode=append",
             f"--output=\"{batch.cluster / 'logs' / log}\"", *more]
    return (f"#!/bin/bash\n# {title}\n" + "".join(f"#SBATCH {line}\n" for line in lines) + f"""set -u
malus={quote(batch.malus)}
cluster={quote(batch.cluster)}
fail() {{ echo "$1 on the node $(hostname); expected $2" >&2; exit 1; }}
[ -x "$malus" ] || fail "$malus cannot be run" "a program that all nodes see: submit --malus FILE"
[ -r "$cluster/{batch.jobs}" ] || fail "$cluster/{batch.jobs} cannot be read" "a folder that all nodes see: submit -o FOLDER"
""")


def prepare_script(batch: Batch) -> str:
    """Bakes a model once, and reads every job, so that a wrong one fails once and not in every task."""
    text = header(batch, "Bakes the pack and checks the jobs of a batch.", "malus-prepare", "prepare.log", batch.slurm)
    if batch.model is not None:
        text += f'"$malus" bake {quote(batch.model)} -o "$cluster/scene.pack" {quote(*batch.bake)} || exit\n'
    # The last of a million shards has no frame of a smaller batch.
    return text + f"""check="$cluster/check-$SLURM_JOB_ID"
"$malus" batch "$cluster/scene.pack" "$cluster/{batch.jobs}" -o "$check" {quote(*batch.options)} \\
  --shard 1000000/1000000
code=$?
rm -rf "$check"
exit "$code"
"""


def frames_script(batch: Batch) -> str:
    """One shard. USR1 arrives before the time limit, TERM when the job is cancelled or preempted."""
    threads = "" if "--threads" in batch.options else '--threads "${SLURM_CPUS_ON_NODE:-0}" '
    return header(batch, "Renders a shard of a batch.", "malus-frames", "frames-%a.log",
                  [f"--array=1-{batch.tasks}", "--signal=B:USR1@120", *batch.slurm, *batch.slurm_frames]) + f"""
shard="$cluster/shards/$SLURM_ARRAY_TASK_ID-of-{batch.tasks}"
mkdir -p "$shard" || exit
count_frames() {{ local n; n=$(grep -c '"index":' "$shard/manifest.jsonl" 2>/dev/null); echo "${{n:-0}}"; }}
echo "task $SLURM_ARRAY_TASK_ID on $(hostname), node ${{SLURMD_NODENAME:-}}, restart ${{SLURM_RESTART_COUNT:-0}}"

# A node that lost contact with the controller may still run an earlier start of this task, on the same host.
flock "$shard" true 2>/dev/null

cancelled= child=
trap '[ -z "$child" ] || kill -TERM "$child" 2>/dev/null' USR1
trap 'cancelled=1; [ -z "$child" ] || kill -TERM "$child" 2>/dev/null' TERM
before=$(count_frames)
"$malus" batch "$cluster/scene.pack" "$cluster/{batch.jobs}" -o "$shard" {threads}{quote(*batch.options)} \\
  --shard "$SLURM_ARRAY_TASK_ID/{batch.tasks}" &
child=$!
wait "$child"; code=$?
while kill -0 "$child" 2>/dev/null; do wait "$child"; code=$?; done

# A killed run continues by the manifest. It is queued again if it finished a frame, so that restarts come to an end.
[ "$code" -lt 128 ] || sleep 1  # TERM of a cancelled job may reach the shell after the renderer
if [ "$code" -ge 128 ] && [ -z "$cancelled" ] && [ "$(count_frames)" -gt "$before" ]; then
  echo "task $SLURM_ARRAY_TASK_ID: ended with code $code after $(($(count_frames) - before)) frames, queued again"
  trap - TERM
  # Not SLURM_JOB_ID: that of the last task is the number of the whole array.
  scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID" && exec sleep 300  # Slurm ends this process
fi
exit "$code"
"""


def merge_script(batch: Batch) -> str:
    return header(batch, "Checks and joins the shards of a batch.", "malus-merge", "merge.log", batch.slurm) + f"""
shards=()
for ((k = 1; k <= {batch.tasks}; ++k)); do shards+=("$cluster/shards/$k-of-{batch.tasks}"); done
exec "$malus" merge "${{shards[@]}}" -o {quote(batch.folder)}
"""


def write_scripts(batch: Batch) -> None:
    for name, text in ((PREPARE, prepare_script(batch)), (FRAMES, frames_script(batch)), (MERGE, merge_script(batch))):
        path = batch.cluster / name
        path.write_text(text, encoding="utf-8")
        path.chmod(0o755)
