/** What the pictures of the command line have in common. */
@NullMarked
package io.troupe.demo.svg;

import org.jspecify.annotations.NullMarked;
