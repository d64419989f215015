/** The registry of services: who offers what, who is well, who is started when somebody needs it. */
@NullMarked
package io.troupe.services.broker;

import org.jspecify.annotations.NullMarked;
