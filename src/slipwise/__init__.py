"""Slipwise: which physical effect does the model of a structure on sliding bearings lack?"""
