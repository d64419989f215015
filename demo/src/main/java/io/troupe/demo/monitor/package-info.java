/** Running programs compared with their declared protocols. */
@NullMarked
package io.troupe.demo.monitor;

import org.jspecify.annotations.NullMarked;
