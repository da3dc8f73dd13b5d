"""What a diagnosis and a search for a law leave in a session: plain data that lasts, and effects to be taken over."""

from collections.abc import Mapping
from datetime import date
from pathlib import Path
from typing import Any

from slipwise.diagnosis.result import Diagnosis
from slipwise.discovery.result import Discovery
from slipwise.errors import SettingError
from slipwise.relations.parameters import Term
from slipwise.session.state import EffectOf, terms_from_json, terms_json


def explained(found: Diagnosis, of: tuple[str, ...]) -> dict[str, Any]:
    """Return what a session keeps of a diagnosis.

    Its suggestion is what it names; where nothing that matters is missing, what is there and does not matter, for the
    user may want the error at the floor all the same.

    Args:
        found: the diagnosis.
        of: labels of the effects of the model that was diagnosed.
    """
    best = found.search.best
    named, minor = found.verdict.effects, found.verdict.minor if found.verdict.kind == "complete" else ()
    terms = best.terms if named else tuple(t for t in best.terms if t.effect.name in minor)
    values = found.final.solution.values if named else best.solution.values
    suggestion = [
        {**said, "values": {n: values[f"{t.label}.{n}"] for n in t.effect.parameter_names}}
        for t, said in zip(terms, terms_json(terms), strict=True)
    ]
    return {**found.as_json(), "of": list(of), "suggestion": suggestion}


def suggested(content: Mapping[str, Any] | None, effect_of: EffectOf) -> list[tuple[Term, Mapping[str, float]]]:
    """Return the effects that a diagnosis suggests, with their fitted parameters.

    Raises:
        SettingError: there was no diagnosis, or it names none.
    """
    parts = content["suggestion"] if content else ()
    if not parts:
        raise SettingError("no diagnosis has named an effect yet; `explain` looks for one")
    return list(zip(terms_from_json(parts, effect_of), (part["values"] for part in parts), strict=True))


def discovered(found: Discovery, folder: Path, of: tuple[str, ...]) -> dict[str, Any]:
    """Write the laws that were found as effect files, and give what a session keeps of them.

    Args:
        found: the search.
        folder: that takes the files.
        of: labels of the effects of the model that was searched from.
    """
    return {**found.written(folder, "law", date.today().isoformat()).as_json(), "of": list(of)}
