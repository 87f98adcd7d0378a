require "ricochet.core".plot {}
