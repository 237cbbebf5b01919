//! What stands in a city: buildings in local metres, and where they are on the map.
