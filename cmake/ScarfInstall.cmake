# To be filled with the install rules.
