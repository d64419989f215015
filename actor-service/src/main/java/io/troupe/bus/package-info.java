/**
 * The messaging infrastructure between components: publish and subscribe, request and reply.
 *
 * <p>Start with {@link io.troupe.bus.Bus} and its {@link io.troupe.bus.BusPort}s. A {@link io.troupe.bus.BusTopic}
 * names what is published, an {@link io.troupe.bus.Operation} what can be requested. A
 * {@link io.troupe.bus.BusObserver} is notified of every {@link io.troupe.bus.Loss}.
 *
 * <p>Inside: {@code Bus} routes each {@link io.troupe.bus.BusMessage} to the {@code InboundQueue} of a
 * {@code TopicSubscription} or an {@code OperationHandler}, or to {@code PendingRequests}; other nodes are reached over
 * a {@code Transport}.
 */
@NullMarked
package io.troupe.bus;

import org.jspecify.annotations.NullMarked;
