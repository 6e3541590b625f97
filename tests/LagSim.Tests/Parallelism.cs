using Xunit;

// One more than the machine that this is made for has cores: many tests wait, for processes, sockets and timers. With two the whole took
// 435 s there, with three 352 s; what measures real time runs alone either way (Cli/RealTime.cs, the collection "alone").
[assembly: CollectionBehavior(MaxParallelThreads = 3)]
