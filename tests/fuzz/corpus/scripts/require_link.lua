require "link"
