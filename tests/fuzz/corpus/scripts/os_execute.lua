os.execute("touch evil")
