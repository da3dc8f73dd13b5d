"""Diagnosis: which physical effect does a model lack?"""
