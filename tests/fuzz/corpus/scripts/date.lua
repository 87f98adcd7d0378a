print(os.date(("%c"):rep(1e7)))
