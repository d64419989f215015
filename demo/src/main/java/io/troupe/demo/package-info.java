/** The command line {@code troupe}: {@link io.troupe.demo.Main} and the commands that run the paper's robots. */
@NullMarked
package io.troupe.demo;

import org.jspecify.annotations.NullMarked;
