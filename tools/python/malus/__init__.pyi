from collections.abc import Sequence
from os import PathLike
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

class Error(ValueError): ...

class Image:
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def method(self) -> str: ...
    @property
    def backend(self) -> str: ...
    @property
    def device(self) -> str: ...
    @property
    def trace_ms(self) -> float: ...
    @property
    def rgb(self) -> NDArray[np.float32]: ...
    @property
    def stokes(self) -> NDArray[np.float32]: ...
    @property
    def camera(self) -> dict[str, Any]: ...
    @property
    def truth(self) -> dict[str, NDArray[np.float32]]: ...
    def dolp(self) -> NDArray[np.float64]: ...
    def aolp(self) -> NDArray[np.float64]: ...
    def save(self, file: str | PathLike[str], *, exposure: float | None = None) -> None: ...

class Scene:
    @staticmethod
    def load(file: str | PathLike[str]) -> Scene: ...
    @property
    def name(self) -> str: ...
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def depth(self) -> int: ...
    @property
    def triangles(self) -> int: ...
    @property
    def materials(self) -> list[str]: ...
    @property
    def meshes(self) -> list[str]: ...
    @property
    def effects(self) -> dict[str, tuple[bool, str]]: ...
    def render(
        self,
        *,
        method: str | None = None,
        backend: Literal["embree", "vulkan", "reference"] = "embree",
        width: int | None = None,
        height: int | None = None,
        camera: dict[str, Any] | None = None,
        polarizer: float | None = None,
        analyser: Literal["right", "left"] | None = None,
        wave_plate: float | tuple[float, float] | None = None,
        effects: str | Sequence[str] | None = None,
        depth: int | None = None,
        samples: int | None = None,
        light_samples: int | None = None,
        region: Sequence[int] = (),
        materials: dict[str, dict[str, Any]] | None = None,
        lights: bool | Sequence[bool] | None = None,
        environment: dict[str, float] | None = None,
        wavelengths: Sequence[float] | None = None,
        exposure: float | None = None,
        tolerance: float = 0.0,
        stokes: bool = True,
        ground_truth: bool = False,
        threads: int = 0,
        device: str = "",
    ) -> Image: ...

class Material:
    @property
    def name(self) -> str: ...
    def index(self, wavelength: float = 532) -> complex: ...
    def mueller(
        self, angles: ArrayLike, *, wavelength: float = 532, outside: float = 1.0, transmission: bool = False
    ) -> NDArray[np.float64]: ...
    def reflectance(
        self, angles: ArrayLike, *, wavelength: float = 532, outside: float = 1.0
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...

def bake(
    file: str | PathLike[str],
    *,
    output: str | PathLike[str] | None = None,
    camera: str = "",
    environment: str | PathLike[str] | None = None,
    allow_open_glass: bool = False,
) -> Scene: ...
def material(name: str | None = None, *, eta: float | None = None, k: float = 0.0) -> Material: ...
def presets() -> list[str]: ...
def methods() -> list[str]: ...
def compare(
    packs: str | PathLike[str] | Sequence[str | PathLike[str]],
    *,
    folder: str | PathLike[str] | None = None,
    methods: Sequence[str] | None = None,
    backends: Sequence[str] = ("embree",),
    width: int | None = None,
    rounds: int = 7,
    minutes: float = 0.0,
    polarizer: float | None = None,
    threads: int = 0,
    device: str = "",
) -> dict[str, Any]: ...
