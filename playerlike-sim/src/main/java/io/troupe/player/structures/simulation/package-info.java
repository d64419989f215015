/** Data of the simulation interface: the poses of models. */
@NullMarked
package io.troupe.player.structures.simulation;

import org.jspecify.annotations.NullMarked;
