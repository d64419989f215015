package io.troupe.actor;
