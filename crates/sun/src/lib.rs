//! Where the sun stands: places, periods of days and hours, positions, arcs of its way.
