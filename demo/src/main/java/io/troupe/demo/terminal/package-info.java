/** What a person sees on a terminal while a command works. */
@NullMarked
package io.troupe.demo.terminal;

import org.jspecify.annotations.NullMarked;
