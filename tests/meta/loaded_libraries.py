"""The program loads at its start only small libraries: each one costs every run, however short.

    python3 loaded_libraries.py PROGRAM
"""

import subprocess
import sys

# Only runs that read a mesh file need assimp, sweeps that write such a file HDF5; tinygltf as a library draws along images and compressed meshes.
LARGE = ("assimp", "tinygltf", "draco", "stb", "minizip", "hdf5")

listing = subprocess.run(["ldd", sys.argv[1]], capture_output=True, text=True, check=True).stdout
names = [line.split()[0] for line in listing.splitlines() if line.strip()]
loaded = [name for name in names if any(name.startswith("lib" + large) for large in LARGE)]
if loaded or not any(name.startswith("libc.") for name in names):
    sys.exit(f"{sys.argv[1]} loads at its start: {', '.join(loaded or names)}")
