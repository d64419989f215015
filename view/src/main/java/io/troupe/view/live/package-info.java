/** The live page: a server for browsers, the messages it sends, commands of viewers, and pages in a file. */
@NullMarked
package io.troupe.view.live;

import org.jspecify.annotations.NullMarked;
