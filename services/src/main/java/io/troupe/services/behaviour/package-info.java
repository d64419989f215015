/** Control laws as pure functions: sensor readings in, velocity out. */
@NullMarked
package io.troupe.services.behaviour;

import org.jspecify.annotations.NullMarked;
