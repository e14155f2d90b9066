"""Building and farm machines, cranes, mills, plant."""
