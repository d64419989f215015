/** {@code troupe verify}: the paper's statements about its Petri nets, compared with our results. */
@NullMarked
package io.troupe.demo.verify;

import org.jspecify.annotations.NullMarked;
