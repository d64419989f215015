/** The service registry: providers of services, their health, their start on demand, and failover. */
@NullMarked
package io.troupe.services.broker;

import org.jspecify.annotations.NullMarked;
