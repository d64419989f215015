/** The main job over hosts: the options of the bus, and commands that use it. */
@NullMarked
package io.troupe.demo.hosts;

import org.jspecify.annotations.NullMarked;
