"""Read a Dewesoft file in a process of its own and keep its channels: the library ends the process at a damaged file.

Run as `python -m slipwise.data_files.dewesoft_channels FILE OUT`.
"""

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np


def keep_channels(library: Any, path: str, out: Path) -> None:
    """Write the channels of a file as .npy files, times and values of each (2, n), and what is known of them as JSON.

    Args:
        library: the module dwdatareader.
        path: the file.
        out: folder to write to.
    """
    told: dict[str, Any] = {"channels": [], "left": [], "error": ""}
    try:
        with library.DWFile(path) as file:
            for channel in file.values():
                if channel.number_of_samples < 2 or channel.array_size != 1:
                    continue
                try:
                    time, values = channel.scaled()
                except library.DWError as error:
                    told["left"].append(f"{channel.name} ({error.message})")
                    continue
                if np.asarray(values).dtype.kind in "fiu":
                    np.save(out / f"{len(told['channels'])}.npy", np.stack([time, np.asarray(values, dtype=float)]))
                    told["channels"].append([str(channel.name), str(channel.unit)])
    except library.DWError as error:
        told["error"] = error.message
    (out / "told.json").write_text(json.dumps(told), encoding="utf-8")


if __name__ == "__main__":
    import dwdatareader  # type: ignore[import-not-found]

    keep_channels(dwdatareader, sys.argv[1], Path(sys.argv[2]))
