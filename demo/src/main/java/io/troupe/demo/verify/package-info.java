/** {@code troupe verify}: what the paper says about its Petri nets, beside what we find. */
@NullMarked
package io.troupe.demo.verify;

import org.jspecify.annotations.NullMarked;
