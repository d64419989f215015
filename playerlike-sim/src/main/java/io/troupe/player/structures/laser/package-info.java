/** Data of the laser interface: scans. */
@NullMarked
package io.troupe.player.structures.laser;

import org.jspecify.annotations.NullMarked;
