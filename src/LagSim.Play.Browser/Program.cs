using System;

// Nothing runs by itself: the page calls PlaygroundExports.
Console.WriteLine("LagSim is loaded.");
