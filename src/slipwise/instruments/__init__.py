"""Instruments: are the gauges telling the truth, without any law of friction?"""
