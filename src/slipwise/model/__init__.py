"""A rig with the effects that act in it: the model, its file, and what it does not use."""

from slipwise.model.model import EffectUse, Model, base_model, use, use_of

__all__ = ["EffectUse", "Model", "base_model", "use", "use_of"]
