io.open("evil", "w")
