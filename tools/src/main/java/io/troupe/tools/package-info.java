/** What only programs and tests need: statistics, child JVMs, the used heap, a progress line, a NATS server. */
@NullMarked
package io.troupe.tools;

import org.jspecify.annotations.NullMarked;
