/** Terminal output, output files and interruption: what the commands share. */
@NullMarked
package io.troupe.demo.terminal;

import org.jspecify.annotations.NullMarked;
