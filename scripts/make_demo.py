"""Make the data of `slipwise demo`: a campaign with a hidden effect, from the second simulator in `benchmarks`.

    python scripts/make_demo.py [--out src/slipwise/demo_data]

The library has no part in the physics of these data. They are kept as parquet with four-byte numbers, which is finer
than the gauges' noise.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from slipwise_benchmarks import make_campaign

ROOT = Path(__file__).parents[1]


def main() -> None:
    """Make, convert, write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=ROOT / "src" / "slipwise" / "demo_data")
    parser.add_argument("--effect", default="run_in")
    parser.add_argument("--seed", type=int, default=2005)
    chosen = parser.parse_args()
    chosen.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary) / "demo"
        truth = make_campaign(folder, chosen.seed, effects=(chosen.effect,), size="medium", rig="bridge1")
        for path in sorted(folder.glob("*.csv")):
            names = path.read_text().splitlines()[0].split(",")
            columns = np.loadtxt(path, delimiter=",", skiprows=1)
            types = [pa.float64() if name.startswith("time") else pa.float32() for name in names]
            arrays = [pa.array(column, kind) for column, kind in zip(columns.T, types, strict=True)]
            pq.write_table(
                pa.Table.from_arrays(arrays, names=names), chosen.out / f"{path.stem}.parquet", compression="zstd"
            )
        words = (folder / "campaign.toml").read_text().replace(".csv", ".parquet")
        (chosen.out / "campaign.toml").write_text(words)
    print(f"{chosen.out}: hidden {truth.missing}, {truth.size_after_fit:.1f} floors after the base fit")


if __name__ == "__main__":
    main()
