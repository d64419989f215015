/**
 * What generated code needs: the base classes of messages, requests and proxies. For generated code and for this
 * library; may change at any time.
 *
 * <p>The packages depend on each other in one direction: {@code internal.loop}, then {@code promise}, then this one,
 * then {@code io.troupe.actor}.
 */
@NullMarked
package io.troupe.actor.internal;

import org.jspecify.annotations.NullMarked;
