"""One sweep over several workers of Dask, each of which runs `gaitc sweep ... --shard I/N`; then `gaitc merge`.

    pip install dask distributed
    python examples/dask/sweep.py --gaitc target/release/gaitc --shards 8 --dir shards --out gaits.parquet -- \
        sweep prescribed_length --over 'psi=1..45 deg:450' --over 'omega=15..25 rad/s:11'

What stands behind `--` are the arguments of gaitc. By default the workers are processes of this machine; `--scheduler ADDRESS`
takes those of a cluster, whose machines need the same gaitc, the same specs and a file system that they share. A worker that
dies is no loss: its shard goes on where it was, on another one.
"""

import argparse
import pathlib
import subprocess
import sys

from dask.distributed import Client, LocalCluster, as_completed


def shard(gaitc, arguments, folder, index, count):
    """Computes one shard, or what is missing of it."""
    command = [gaitc, *arguments, "--dir", f"{folder}/{index}", "--shard", f"{index}/{count}", "--resume", "--threads", "1"]
    run = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if run.returncode != 0:
        raise RuntimeError(f"shard {index}/{count}: {run.stderr.strip()}")
    return index


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--gaitc", default="gaitc", help="the program")
    parser.add_argument("--shards", type=int, default=8, help="how many parts the study is cut into")
    parser.add_argument("--workers", type=int, help="processes of this machine (default: one a core)")
    parser.add_argument("--scheduler", help="address of a running Dask scheduler, instead of processes of this machine")
    parser.add_argument("--dir", default="shards", help="folder for the shards")
    parser.add_argument("--out", required=True, help="the table: .csv or .parquet")
    parser.add_argument("arguments", nargs="+", help="arguments of gaitc: sweep or basin, the model, --over ...")
    options = parser.parse_args()

    folder = pathlib.Path(options.dir).resolve()
    if options.scheduler:
        cluster, client = None, Client(options.scheduler)
    else:
        cluster = LocalCluster(n_workers=options.workers, threads_per_worker=1, dashboard_address=None)
        client = Client(cluster)
    try:
        numbers = range(1, options.shards + 1)
        # A shard that fails is tried again, on another worker if need be.
        futures = [
            client.submit(shard, options.gaitc, options.arguments, str(folder), i, options.shards, pure=False, retries=2)
            for i in numbers
        ]
        for done, future in enumerate(as_completed(futures), start=1):
            print(f"shard {future.result()} of {options.shards} ({done} done)", file=sys.stderr)
    finally:
        client.close()
        if cluster:
            cluster.close()
    folders = [str(folder / str(i)) for i in numbers]
    return subprocess.run([options.gaitc, "merge", *folders, "--out", options.out]).returncode


if __name__ == "__main__":
    sys.exit(main())
