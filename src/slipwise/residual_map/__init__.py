"""What a missing force may depend on, how it may enter, and the curve that the residual of a relation asks for."""
