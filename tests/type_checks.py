"""Faster decorator for jaxtyping's import hook: checks are compiled at a function's first call, and each value is checked once.

jaxtyping's own decorator compiles two checks per function on import and checks the arguments of each call twice. That was half
of the time of collecting the tests, and up to 40 % of the time of running them. Annotations are evaluated after collection, so
names that are defined later in a module are checked too.
"""

import inspect
from collections.abc import Callable
from dataclasses import is_dataclass
from functools import partial, wraps
from types import FunctionType
from typing import Any, get_args, get_type_hints
from weakref import WeakSet

import jaxtyping
from beartype import BeartypeConf, beartype

CONFIG = BeartypeConf(violation_type=jaxtyping.TypeCheckError)
REAL = jaxtyping.jaxtyped
EVALUATED: dict[tuple[str, str], Any] = {}  # annotations by module and text
WAITING: WeakSet[FunctionType] = WeakSet()
SUSPENDED = inspect.CO_GENERATOR | inspect.CO_COROUTINE | inspect.CO_ASYNC_GENERATOR


def install() -> None:
    """Replace the decorator that the import hook inserts; call it before anything of anymesh is imported."""
    jaxtyping.jaxtyped = jaxtyped


def evaluate() -> None:
    """Evaluate the annotations of all functions so far, before a test replaces a name that they use."""
    for function in list(WAITING):
        hints(function)
    WAITING.clear()


def jaxtyped(target: Any = None, **options: Any) -> Any:
    """Decorate a function or the constructor of a dataclass in place of `jaxtyping.jaxtyped`."""
    if target is None:
        return partial(jaxtyped, **options)
    if isinstance(target, type):
        init = target.__init__
        if is_dataclass(target) and isinstance(init, FunctionType) and init.__globals__ is not globals():
            target.__init__ = checked(init)  # ty: ignore[invalid-assignment]
        return target
    if not isinstance(target, FunctionType) or target.__code__.co_flags & SUSPENDED:
        return REAL(target, **options)
    return checked(target)


def checked(function: FunctionType) -> Callable:
    """Return the function with checks of its arguments and its result, which the first call compiles."""
    WAITING.add(function)
    ready: Callable | None = None

    @wraps(function)
    def wrapper(*args: Any, **kwargs: Any) -> Any:
        __tracebackhide__ = True
        nonlocal ready
        if ready is None:
            ready = compiled(function)
        return ready(*args, **kwargs)

    return wrapper


def compiled(function: FunctionType) -> Callable:
    """Return the function with its checks; those of array shapes share the sizes of their dimensions within a call."""
    resolved = hints(function)
    copy = FunctionType(function.__code__, function.__globals__, function.__name__, function.__defaults__, function.__closure__)
    copy.__kwdefaults__ = function.__kwdefaults__
    copy.__qualname__, copy.__module__ = function.__qualname__, function.__module__
    copy.__annotations__ = resolved
    checks = beartype(conf=CONFIG)(copy)
    if not any(map(has_shape, resolved.values())):
        return checks
    scope: Any = REAL("context")

    def scoped(*args: Any, **kwargs: Any) -> Any:
        __tracebackhide__ = True
        with scope:
            return checks(*args, **kwargs)

    return scoped


def hints(function: FunctionType) -> dict[str, Any]:
    """Return the annotations, evaluated; Any where a name exists for static type checkers only."""
    return {name: evaluated(annotation, function) for name, annotation in function.__annotations__.items()}


def evaluated(annotation: Any, function: FunctionType) -> Any:
    if not isinstance(annotation, str):
        return annotation
    key = function.__module__, annotation
    if key not in EVALUATED:

        def one(value: Any) -> None:
            raise NotImplementedError

        one.__annotations__ = {"value": annotation}
        try:
            EVALUATED[key] = get_type_hints(one, function.__globals__, include_extras=True)["value"]
        except Exception:  # of any kind, since the annotation is evaluated
            return Any
    return EVALUATED[key]


def has_shape(hint: Any) -> bool:
    """Return whether an annotation contains one of an array."""
    return (isinstance(hint, type) and issubclass(hint, jaxtyping.AbstractArray)) or any(map(has_shape, get_args(hint)))
