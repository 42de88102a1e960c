import os
from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

Floats = NDArray[np.float64]
Records = NDArray[np.void]
SceneLike = Union[str, "os.PathLike[str]", Mapping[str, Any]]
Value = Union[float, str, Sequence[float], Floats]

class SceneError(ValueError):
    message: str
    file: Optional[str]
    line: Optional[int]
    column: Optional[int]
    key: Optional[str]
    def __init__(
        self,
        message: str,
        file: Optional[str] = ...,
        line: Optional[int] = ...,
        column: Optional[int] = ...,
        key: Optional[str] = ...,
    ) -> None: ...

class Sweep:
    warnings: List[str]
    def __len__(self) -> int: ...
    def __getitem__(self, name: str) -> NDArray[Any]: ...
    @property
    def quantities(self) -> List[str]: ...
    @property
    def columns(self) -> List[str]: ...
    @property
    def rows(self) -> Records: ...
    @property
    def failures(self) -> Dict[int, str]: ...

Range = Tuple[Value, Value]
Grid = Tuple[Value, Value, int]

def sweep(
    scene: SceneLike,
    vary: Union[None, str, Sequence[str], Mapping[str, Grid]] = ...,
    sample: Union[None, str, Sequence[str], Mapping[str, str]] = ...,
    *,
    report: Union[str, Sequence[str]] = ...,
    count: Optional[int] = ...,
    seed: int = ...,
    design: str = ...,
    correlate: Optional[Mapping[Tuple[str, str], float]] = ...,
    threads: int = ...,
    set: Optional[Mapping[str, Value]] = ...,
    **options: Union[None, float, str],
) -> Sweep: ...

class Aim:
    def report(self) -> Dict[str, Any]: ...
    @property
    def status(self) -> str: ...
    @property
    def ok(self) -> bool: ...
    @property
    def solutions(self) -> List[Dict[str, Any]]: ...
    @property
    def closest(self) -> Optional[Dict[str, Any]]: ...

def aim(
    scene: SceneLike,
    vary: Union[str, Sequence[str], Mapping[str, Range]],
    hit: Optional[str] = ...,
    *,
    at: Optional[Sequence[Value]] = ...,
    body: str = ...,
    conditions: Union[str, Sequence[str]] = ...,
    minimise: str = ...,
    set: Optional[Mapping[str, Value]] = ...,
    **options: Union[None, float, str],
) -> Aim: ...

class Motion:
    @property
    def status(self) -> str: ...
    @property
    def ok(self) -> bool: ...
    @property
    def failure(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def method(self) -> str: ...
    @property
    def start_time(self) -> float: ...
    @property
    def end_time(self) -> float: ...
    @property
    def bodies(self) -> List[str]: ...
    @property
    def parameters(self) -> Dict[str, float]: ...
    @property
    def states(self) -> Dict[str, float]: ...
    @property
    def warnings(self) -> List[str]: ...
    @property
    def statistics(self) -> Dict[str, float]: ...
    @property
    def impacts(self) -> Records: ...
    @property
    def events(self) -> Records: ...
    @property
    def contacts(self) -> Records: ...
    @property
    def final(self) -> Records: ...
    def state(self, t: float) -> Records: ...
    def position(self, body: str, t: ArrayLike) -> Floats: ...
    def velocity(self, body: str, t: ArrayLike) -> Floats: ...
    def orientation(self, body: str, t: ArrayLike) -> Floats: ...
    def angular_velocity(self, body: str, t: ArrayLike) -> Floats: ...
    @overload
    def value(self, state: str, t: float) -> float: ...
    @overload
    def value(self, state: str, t: ArrayLike) -> Floats: ...
    def report(self) -> Dict[str, Any]: ...

class Comparison:
    @property
    def reference(self) -> Dict[str, Any]: ...
    @property
    def rows(self) -> Records: ...
    @property
    def warnings(self) -> List[str]: ...
    def report(self) -> Dict[str, Any]: ...

class Page:
    html: str
    def save(self, path: Union[str, "os.PathLike[str]"]) -> None: ...
    def _repr_html_(self) -> str: ...

class Method(NamedTuple):
    name: str
    aliases: Tuple[str, ...]
    order: int
    dense_order: int
    control: str
    known_as: str
    summary: str

class Event:
    when: str
    terminal: Union[bool, int]
    direction: float
    def __init__(self, when: str, terminal: Union[bool, int] = ..., direction: float = ...) -> None: ...

class OdeSolution:
    ts: Floats
    t_min: float
    t_max: float
    def __call__(self, t: ArrayLike) -> NDArray[Any]: ...

class OdeResult(Dict[str, Any]):
    t: Floats
    y: NDArray[Any]
    sol: Optional[OdeSolution]
    t_events: Optional[List[Floats]]
    y_events: Optional[List[NDArray[Any]]]
    nfev: int
    njev: int
    nlu: int
    status: int
    message: str
    success: bool

EventLike = Union[str, Event, Callable[..., Any]]
Law = Union[str, Sequence[str], Mapping[str, str], Callable[..., Any]]

def run(
    scene: SceneLike,
    set: Optional[Mapping[str, Value]] = ...,
    *,
    method: Optional[str] = ...,
    step: Optional[Value] = ...,
    rtol: Optional[Value] = ...,
    atol: Optional[Value] = ...,
    end: Optional[Value] = ...,
    orientation: Optional[str] = ...,
) -> Motion: ...
def check(
    scene: SceneLike,
    set: Optional[Mapping[str, Value]] = ...,
    *,
    method: Optional[str] = ...,
    step: Optional[Value] = ...,
    rtol: Optional[Value] = ...,
    atol: Optional[Value] = ...,
    end: Optional[Value] = ...,
    orientation: Optional[str] = ...,
) -> List[str]: ...
def compare(
    scene: SceneLike,
    methods: Union[str, Sequence[str]] = ...,
    *,
    steps: Sequence[int] = ...,
    rtols: Sequence[float] = ...,
    orientations: Union[str, Sequence[str]] = ...,
    reference: str = ...,
    set: Optional[Mapping[str, Value]] = ...,
    method: Optional[str] = ...,
    step: Optional[Value] = ...,
    rtol: Optional[Value] = ...,
    atol: Optional[Value] = ...,
    end: Optional[Value] = ...,
    orientation: Optional[str] = ...,
) -> Comparison: ...
def view(
    scene: Union[SceneLike, Motion],
    *others: Motion,
    set: Optional[Mapping[str, Value]] = ...,
    method: Optional[str] = ...,
    step: Optional[Value] = ...,
    rtol: Optional[Value] = ...,
    atol: Optional[Value] = ...,
    end: Optional[Value] = ...,
    orientation: Optional[str] = ...,
) -> Page: ...
def methods() -> List[Method]: ...
def columns(rows: Records) -> Dict[str, NDArray[Any]]: ...
def solve_ivp(
    fun: Law,
    t_span: Sequence[float],
    y0: Any,
    method: Optional[str] = ...,
    t_eval: Optional[ArrayLike] = ...,
    dense_output: bool = ...,
    events: Union[None, EventLike, Sequence[EventLike]] = ...,
    vectorized: bool = ...,
    args: Union[None, Tuple[Any, ...], Mapping[str, Value]] = ...,
    *,
    rtol: Optional[float] = ...,
    atol: Optional[ArrayLike] = ...,
    first_step: Optional[float] = ...,
    max_step: float = ...,
    **options: Any,
) -> OdeResult: ...
