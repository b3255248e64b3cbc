"""Jobs: what an arm can get done in a given time. Import the module of the job, for instance
`from robokin.jobs.visit_collect import read_task, visit`; `python -m robokin.jobs FOLDER` answers
task files.
"""
